// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the simulation, and its two halves for those who look between them.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Brings the neighbour list up to date and does the force pass at the present positions; idempotent until advance().
void compute_forces(World& world);
/// Kick and drift: controls, velocities, positions, time. Needs compute_forces().
void advance(World& world);
/// One step: compute_forces() and advance().
void step(World& world);

}  // namespace crackle
