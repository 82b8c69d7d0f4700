// SPDX-License-Identifier: GPL-3.0-or-later
// Diagrams of joint traces: their positions in the box, and their directions.
// Tested by tests/tools/joints/joints_test.cpp.
#pragma once

#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/joint_report.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// Map of the box, with the same scale on both axes and a colour for each source of traces.
Panel trace_map(const JointNetwork& network);

/// Rose diagram of trace length by direction, in petals of 10 degrees that point both ways. The area of a petal is
/// proportional to its fraction of the total length; sources are stacked.
Panel trace_rose(const JointNetwork& network, const JointReport& report);

}  // namespace crackle::plot
