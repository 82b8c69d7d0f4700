// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the simulation, and its two halves for callers that observe the state between them.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Updates the neighbour list and computes forces at the current positions. Calling it again before advance() has no
/// effect.
void compute_forces(World& world);
/// Kick and drift: updates controls, velocities, positions and time. Call compute_forces() first.
void advance(World& world);
/// One full step: compute_forces() and then advance().
void step(World& world);

}  // namespace crackle
