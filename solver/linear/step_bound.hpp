// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable time step, from one small matrix per body. It needs no factorisation, so it can be
// computed at every rebuild of the neighbour list. For the exact limit see critical_step.hpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Guaranteed bound on the stable time step, s: below it, 4M - 2Δt·C - Δt²·K is positive definite even if all listed
/// points carry load. Derivation: step_bound.cpp.
/// @param limiting receives the body that determines the bound; unchanged if there is none
double stable_step_bound(const World& world, BodyIndex* limiting = nullptr);
/// Computes StepControl::step_bound for the points that carry load. In a world without bonds, all points within the
/// common skin count instead.
void find_step_bound(World& world);
/// Lowers StepControl::step_bound for the points that began to carry load in the last force pass.
/// @return false if the bound must be computed again, because too many bodies gained points or because it is now below
/// the time step in use
bool lower_step_bound(World& world);
/// Fraction of the bound used for an automatic time step: step_scale times safety_factor; without bonds, safety_factor
/// is limited to loose_step_share.
double derived_step_share(const World& world);

}  // namespace crackle
