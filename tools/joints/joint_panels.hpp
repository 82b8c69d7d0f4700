// SPDX-License-Identifier: GPL-3.0-or-later
// Traces of joints as figures: where they lie in the box, and in which directions.
// Tested by tests/tools/joints/joints_test.cpp.
#pragma once

#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/joint_report.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// The box at equal scales, each source in a colour of its own.
Panel trace_map(const JointNetwork& network);

/// Length by direction, 10 degrees a petal, both ways: the area of a petal is its share of all length, sources one
/// upon the other.
Panel trace_rose(const JointNetwork& network, const JointReport& report);

}  // namespace crackle::plot
