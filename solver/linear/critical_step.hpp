// SPDX-License-Identifier: GPL-3.0-or-later
// The exact stable step of a world: the largest Δt for which 4M - 2Δt·C - Δt²·K stays positive definite.
//
// Leapfrog with the lagged dashpot, M(v(n+½) - v(n-½))/Δt = -K x(n) - C v(n-½), multiplies a mode by z with
//     M(z - 1)² + Δt C(z - 1) + Δt² K z = 0.
// With M, K > 0 and C >= 0 the first root to leave the unit circle does so at z = -1, where 4M - 2Δt C - Δt² K becomes
// singular; one spring and dashpot gives the guide's Δt = 2 sqrt(m/k)(sqrt(h² + 1) - h). The unknown is found by
// Newton's method on the Rayleigh quotient: for a given vector the root of 4m - 2Δt c - Δt² k lies at or above the
// limit, for the extreme vector of the pencil at that Δt (Lanczos, Spectra) it is closer by the square. A sparse
// Cholesky factorisation just below the result then proves that nothing was missed.
// Tested by tests/solver/linear/step_bound_test.cpp and stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "solver/linear/springs.hpp"

namespace crackle {

struct CriticalStep {
    double
        step;  ///< s, stable at and below: the root less `margin`, within 2 % of it if not proved (lanczos_bound.hpp)
    double root;                   ///< s, where the pencil becomes singular; infinite where nothing is stiff
    bool proved;                   ///< Cholesky: 4M - 2Δt·C - Δt²·K is positive definite at `step`
    std::vector<BodyMotion> mode;  ///< per body, the motion that grows first; largest component of M^½ times it 1
};

/// Beyond so many degrees of freedom (100,000 free bodies) a step within 2 % of it takes its place (lanczos_bound.hpp):
/// factors of millions of rows need minutes and gigabytes.
inline constexpr std::int64_t most_exact_unknowns = 300'000;

/// Relative distance kept from the root, far above the rounding of the factorisation.
inline constexpr double critical_step_margin = 1e-6;

/// @param which points count as closed; with `listed` the result holds until the neighbour list is rebuilt
CriticalStep critical_step(const World& world, ClosedPoints which);

/// Whether `dt` is at or below critical_step(), by one factorisation.
bool stable_at(const World& world, ClosedPoints which, double dt);

/// Largest |z| of all modes at time step `dt`: 1 up to the limit, beyond it the growth of the fastest mode a step,
/// found by the same iteration on (1 + ζ)²M - Δt(1 + ζ)C - Δt²ζK with z = -ζ.
double growth_per_step(const World& world, ClosedPoints which, double dt);

}  // namespace crackle
