// SPDX-License-Identifier: GPL-3.0-or-later
// The time step during a run: its stable bound changes as contact points appear and disappear, and the step is kept
// below the bound.
// Tested by tests/solver/measure/health_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Rebuilds the neighbour list if bodies have used up its skin, and then computes the stable bound again.
/// @throws UnstableRun if a given time step is above the stable bound (not with allow_unstable)
void refresh_neighbours(World& world);
/// Computes StepControl::step_bound (see find_step_bound() for the points that count) and keeps the step below it.
/// @throws UnstableRun under the same conditions as refresh_neighbours()
void evaluate_step_bound(World& world);
/// Computes the exact stable step for the points in contact. In a bonded world, also sets the target of automatic step
/// control (StepControl::step_goal).
void find_exact_step(World& world);
/// Lowers StepControl::step_bound, and an automatic step with it, for points that began to carry load in the last force
/// pass. @throws UnstableRun under the same conditions as refresh_neighbours()
void count_new_points(World& world);
/// Lowers an automatic step to what step_bound allows, or raises it towards step_goal when the bound has risen. @throws
/// UnstableRun under the same conditions as refresh_neighbours()
void keep_step_below_bound(World& world);
/// Sets a fixed time step, s, in place of an automatic step. It may be as large as the exact limit for the points that
/// carry load.
/// @throws UnstableRun if the given time step is above the exact limit (not with allow_unstable)
void set_time_step(World& world, double time_step);

}  // namespace crackle
