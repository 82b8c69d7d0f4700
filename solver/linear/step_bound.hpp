// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable step, from per-body blocks: no factorisation, every time the list is rebuilt. The
// exact limit: critical_step.hpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Guaranteed bound on the stable step, s: 4M - 2Δt·C - Δt²·K stays positive definite below it, over all listed points
/// as if they carried load. Derivation: step_bound.cpp.
/// @param limiting receives the body that sets the bound; left as it is where none does.
double stable_step_bound(const World& world, BodyIndex* limiting = nullptr);
/// Finds StepControl::step_bound again, of the points that carry load (without bonds: of all listed ones).
void find_step_bound(World& world);
/// Lowers StepControl::step_bound by the points that came to carry load in the last force pass.
/// @return false if it has to be found again: more bodies gained points than are looked at, or the step in use lies
/// above
bool lower_step_bound(World& world);
/// Share of the bound that a derived step takes: step_scale times safety_factor, without bonds at most
/// loose_step_share.
double derived_step_share(const World& world);

}  // namespace crackle
