// SPDX-License-Identifier: GPL-3.0-or-later
// The exact stable time step of a world: the largest Δt for which 4M - 2Δt·C - Δt²·K stays positive definite.
//
// Leapfrog with the lagged dashpot, M(v(n+½) - v(n-½))/Δt = -K x(n) - C v(n-½), multiplies a mode by z per step, where
//     M(z - 1)² + Δt C(z - 1) + Δt² K z = 0.
// With M, K > 0 and C >= 0, the first root to leave the unit circle does so at z = -1, where 4M - 2Δt C - Δt² K becomes
// singular. For one spring and dashpot this gives the DEMseg guide's Δt = 2 sqrt(m/k)(sqrt(h² + 1) - h). Δt is found by
// Newton's method on the Rayleigh quotient: for any vector, the root of 4m - 2Δt c - Δt² k is at or above the limit.
// Taking the extreme eigenvector at this Δt (Lanczos, Spectra) for the next iteration squares the error. A sparse
// Cholesky factorisation just below the result then proves that no mode was missed.
// Tested by tests/solver/linear/step_bound_test.cpp and stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "solver/linear/springs.hpp"

namespace crackle {

/// The largest stable time step of a world.
struct CriticalStep {
    double step;  ///< s; steps up to this value are stable. If proved, it is root·(1 - critical_step_margin); otherwise
                  ///< a lower bound, at most 2 % below the limit (lanczos_bound.hpp)
    double root;  ///< s, step at which the matrix becomes singular; infinite if no spring has stiffness
    bool proved;  ///< whether Cholesky has shown that 4M - 2Δt·C - Δt²·K is positive definite at `step`
    std::vector<BodyMotion> mode;  ///< for each body, the mode that becomes unstable first, scaled so that the largest
                                   ///< component of M^½ u is 1
};

/// With more degrees of freedom than this (100,000 free bodies, or 10,000 bonded by faces), a step within 2 % of the
/// limit is computed instead (lanczos_bound.hpp). Factorising millions of rows takes minutes and gigabytes. The rows of
/// faces are three times as long, and their largest eigenvalues lie close together.
inline constexpr std::int64_t most_exact_unknowns = 300'000, most_exact_unknowns_of_faces = 30'000;

/// Relative distance of the result below the root, far above the round-off of the factorisation.
inline constexpr double critical_step_margin = 1e-6;

/// Computes the largest stable time step. @param which points that count as closed; for ClosedPoints::listed, the
/// result holds until the neighbour list is rebuilt. All faces count as intact.
CriticalStep critical_step(const World& world, ClosedPoints which);

/// Whether the time step `dt` (s) is at or below critical_step(); needs a single factorisation.
bool stable_at(const World& world, ClosedPoints which, double dt);

/// Largest |z| of all modes at the time step `dt` (s): 1 up to the stable limit, and the growth per step of the
/// fastest-growing mode above the limit. It is found like the critical step, by iteration on (1 + ζ)²M - Δt(1 + ζ)C -
/// Δt²ζK with z = -ζ.
double growth_per_step(const World& world, ClosedPoints which, double dt);

}  // namespace crackle
