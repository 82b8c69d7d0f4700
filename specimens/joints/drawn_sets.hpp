// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the traces of one [[joint_set]] in a box; make_joints() describes how.
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"
#include "specimens/joints/joint_trace.hpp"
#include "specimens/joints/length_law.hpp"
#include "specimens/joints/orientation_law.hpp"

namespace crackle {

/// Largest number of traces of one set; sets that need more are rejected.
inline constexpr std::size_t most_traces_of_a_set = 100'000;

/// Distribution of the directions of a set.
/// @throws InputError naming the key, if the planes do not intersect the section
OrientationLaw orientation_law(const TestCase& test, std::size_t set);
/// Distribution of the trace lengths of a set, except for length = "persistent" and "gaps".
LengthLaw length_law(const TestCase::JointSet& set);

/// Draws a set. @param source  index to be stored in the traces @throws InputError as make_joints() does
std::vector<JointTrace> draw_set(const TestCase& test, std::size_t set, const OrientationLaw& directions,
                                 const Domain& box, std::size_t source);

/// Length of a trace projected perpendicular to a scan line. The sum of these lengths, divided by the area, is the
/// number of crossings per length of scan line.
double length_across(const JointTrace& trace, double scan_line);

}  // namespace crackle
