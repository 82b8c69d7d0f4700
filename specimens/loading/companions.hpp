// SPDX-License-Identifier: GPL-3.0-or-later
// How far the numbers of a test depend on how it was computed: the same test again at half the time step, half the
// loading rate, half and double the damping.
//
// A specimen that breaks follows one of many branches, and which one a rounding decides; so the peaks of companions
// differ by chance as well as by the error of step and rate. The stated error is the larger of
//   - chance, t·sqrt(2)·s, s the sample standard deviation of x (as asked), x at half the step and x at half the
//     rate, t = 2.920 the 95 % point of Student's distribution with two degrees of freedom: were they
//     independent draws, 90 of 100 further runs would lie within;
//   - rate, 3 |x - x at half the rate|, the grid convergence index of two grids at first order (Roache, J. Fluids Eng.
//     116, 1994): inertia and dashpots act in proportion to the rate, the step's error is of second order;
// and what the rows of the curve resolve, added as independent errors are: the root of the sum of squares. What the
// damping changes is physics as much as error and stands apart.
// Tested by tests/specimens/setup/loading_rate_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/results/numerical_errors.hpp"

namespace crackle {

/// A companion whose peak moved by more than this is on another branch.
inline constexpr double branch_stress_change = 0.03, branch_strain_change = 0.1;

/// The errors of a number from those of the companions (above).
/// @param asked of the test itself  @param resolution by its rows, a share of it  @param value of a companion
NumberError error_of(double asked, double resolution, const std::vector<Companion>& companions,
                     double Companion::*value);

/// Whether the companions by step and rate keep the peak, in stress and in strain. Comparisons with a value that is not
/// a number are false.
bool on_one_branch(const NumberError& stress, const NumberError& strain);

/// Runs the companions of a finished test in memory, as many at a time as there are processors for its threads. One
/// that becomes unstable is reported as such.
/// @return nothing if interrupted, or the test has no peak
std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks);

}  // namespace crackle
