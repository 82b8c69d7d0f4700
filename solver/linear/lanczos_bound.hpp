// SPDX-License-Identifier: GPL-3.0-or-later
// The stable step of worlds too large to factor, within two per cent.
//
// k steps of Lanczos from a random vector miss the largest eigenvalue of a positive semidefinite matrix of n rows by
// more than the share ε with a probability of at most 1.648 √n exp(-√ε(2k - 1)) (Kuczyński and Woźniakowski, SIAM J.
// Matrix Anal. Appl. 13 (1992), 1094). With A(Δt) = 2Δt·C + Δt²·K in mass-scaled coordinates, λ what Lanczos finds of
// A(Δt) and s <= 1, A(sΔt) <= sA(Δt), so that sΔt is stable where sλ/(1 - ε) <= 4.
// Tested by tests/solver/linear/step_bound_test.cpp and stopped_solve_test.cpp.
#pragma once

#include "solver/linear/springs.hpp"

namespace crackle {

class MassScaled;

/// The eigenvalue may be larger by this share than what is found: the step is below the limit by that and at most
/// lanczos_search_error more.
inline constexpr double lanczos_share = 0.018, lanczos_search_error = 0.002;
/// How often a stable step found so is none. The start is the same each time: so is the result.
inline constexpr double lanczos_failure = 1e-9;

/// s, a stable step within 2 % of the largest. @param guess s, any stable step; of a pencil that has stiff points
double lanczos_step(const MassScaled& pencil, double guess);
double lanczos_step(const World& world, ClosedPoints which, double guess);

/// Whether lanczos_step() would take `dt` for stable: never above the limit, always below 0.982 of it.
bool lanczos_finds_stable(const MassScaled& pencil, double dt);
bool lanczos_finds_stable(const World& world, ClosedPoints which, double dt);

}  // namespace crackle
