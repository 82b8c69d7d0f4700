// SPDX-License-Identifier: GPL-3.0-or-later
// Results for joints in summary.json: bond breaks on joints, and the opening, slip and failure of each joint set and
// each trace, at the peak and at the end.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"
#include "specimens/summary/damage_figures.hpp"

namespace crackle {

/// @param world  the world at the end of the test
JointedFigures trace_figures(const BondRecord& bonds, const TestState& state, const World& world);

}  // namespace crackle
