// SPDX-License-Identifier: GPL-3.0-or-later
// One [[joint_set]] drawn in a box: see make_joints().
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"
#include "specimens/joints/joint_trace.hpp"
#include "specimens/joints/length_law.hpp"
#include "specimens/joints/orientation_law.hpp"

namespace crackle {

/// More traces than this in one set are refused.
inline constexpr std::size_t most_traces_of_a_set = 100'000;

/// @throws InputError naming the key, for planes without a trace
OrientationLaw orientation_law(const TestCase& test, std::size_t set);
/// Of lengths that are drawn: not of length = "persistent" and "gaps".
LengthLaw length_law(const TestCase::JointSet& set);

/// @param source given to the traces @throws InputError as make_joints()
std::vector<JointTrace> draw_set(const TestCase& test, std::size_t set, const OrientationLaw& directions,
                                 const Domain& box, std::size_t source);

/// Length of a trace seen along a scan line: of that length of line one in so many crosses it. @param scan_line rad
double length_across(const JointTrace& trace, double scan_line);

}  // namespace crackle
