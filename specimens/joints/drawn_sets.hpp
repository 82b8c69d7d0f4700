// SPDX-License-Identifier: GPL-3.0-or-later
// Generates the random traces of one [[joint_set]] in a box; the comment on make_joints() describes the method.
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_request.hpp"
#include "specimens/joints/joint_trace.hpp"

namespace crackle {

/// Largest number of traces of one set; sets that need more are rejected.
inline constexpr std::size_t most_traces_of_a_set = 100'000;

/// Draws a set. @param set  its index, also stored in the traces @throws InputError under the same conditions as
/// make_joints()
std::vector<JointTrace> draw_set(const JointRequest& joints, std::size_t set, const Domain& box);

/// Length of a trace projected perpendicular to a scan line. The sum of these lengths, divided by the area, is the
/// number of crossings per length of scan line.
double length_across(const JointTrace& trace, double scan_line);

}  // namespace crackle
