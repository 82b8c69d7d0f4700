// SPDX-License-Identifier: GPL-3.0-or-later
// The stable time step of worlds whose matrices are too large to factorise, accurate to 2 %.
//
// k Lanczos steps from a random vector underestimate the largest eigenvalue of a positive semidefinite matrix of n rows
// by more than a fraction ε with a probability of at most 1.648 √n exp(-√ε(2k - 1)). Source: Kuczyński and
// Woźniakowski, SIAM J. Matrix Anal. Appl. 13 (1992), 1094. In mass-scaled coordinates let A(Δt) = 2Δt·C + Δt²·K, and
// let λ be the eigenvalue of A(Δt) found by Lanczos. For s <= 1, A(sΔt) <= sA(Δt), so sΔt is stable if sλ/(1 - ε) <= 4.
// Tested by tests/solver/linear/step_bound_test.cpp and stopped_solve_test.cpp.
#pragma once

#include "solver/linear/springs.hpp"

namespace crackle {

class MassScaled;

/// lanczos_share: fraction ε by which Lanczos may underestimate the eigenvalue. The step is below the limit by this
/// fraction plus at most lanczos_search_error.
inline constexpr double lanczos_share = 0.018, lanczos_search_error = 0.002;
/// Probability that a step found in this way is unstable. The start vector, and therefore the result, is always the
/// same.
inline constexpr double lanczos_failure = 1e-9;

/// A stable time step within 2 % of the largest, s. @param pencil matrices of a world with at least one spring of
/// nonzero stiffness
/// @param guess any stable time step, s
double lanczos_step(const MassScaled& pencil, double guess);
/// A stable time step, s, for a world whose springs are the contact points given by `which`.
double lanczos_step(const World& world, ClosedPoints which, double guess);

/// Whether lanczos_step() would accept the time step `dt` (s) as stable. It rejects any dt above the limit, and accepts
/// any dt below 0.982 times the limit.
bool lanczos_finds_stable(const MassScaled& pencil, double dt);
/// Whether lanczos_step() would accept `dt` (s) for a world whose springs are the contact points given by `which`.
bool lanczos_finds_stable(const World& world, ClosedPoints which, double dt);

}  // namespace crackle
