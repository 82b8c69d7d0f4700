// SPDX-License-Identifier: GPL-3.0-or-later
// The time step while a world changes: its bound is found again where contact points come and go, and the step is kept
// below it.
// Tested by tests/solver/measure/health_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Rebuilds the neighbour list where it is used up, and finds the bound of the new one.
/// @throws UnstableRun if the stable bound is below a time step that was given (not with allow_unstable)
void refresh_neighbours(World& world);
/// StepControl::step_bound of the points that carry load now (without bonds: of all listed ones), and the step kept
/// below. @throws UnstableRun as above
void evaluate_step_bound(World& world);
/// The exact stable step of the points that touch, and what a derived step goes back to among bonds.
void find_exact_step(World& world);
/// Lowers StepControl::step_bound by the points that came to carry load in the last force pass, and the coming steps
/// with it. @throws UnstableRun as above
void count_new_points(World& world);
/// A derived step is lowered to what step_bound allows (up to step_goal again when it rises). @throws UnstableRun
void keep_step_below_bound(World& world);
/// Takes a given step in place of a derived one, up to the exact limit of the points that carry load now.
/// @throws UnstableRun if it lies above (not with allow_unstable)
void set_time_step(World& world, double time_step);

}  // namespace crackle
