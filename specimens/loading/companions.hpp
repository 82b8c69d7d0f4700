// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the numerical error of a test's results. Companions are repeats of the test at half the time step, at half
// the loading rate, and at half and double the damping.
//
// A specimen that breaks follows one of many branches, and round-off decides which one. The peaks of the companions
// therefore differ not only because of time step and rate, but also by chance. The stated error combines the larger of
//   - chance, t·sqrt(2)·s, where s is the sample standard deviation of a result x of the test and of its runs at half
//     the step and at half the rate, and t = 2.920 is the 95 % point of Student's distribution with two degrees of
//     freedom. If the runs were independent draws, 90 of 100 further runs would differ from the test by less;
//   - rate, 3 |x - x at half the rate|, the grid convergence index of two grids at first order (Roache, J. Fluids Eng.
//     116, 1994): effects of inertia and dashpots are proportional to the rate; the error of the time step is of second
//     order;
// with the resolution of the curve rows. These two are independent errors; the root of the sum of squares is taken.
// Damping has a physical effect as well as causing an error, so its effect is stated separately.
// Tested by tests/specimens/setup/loading_rate_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/results/numerical_errors.hpp"

namespace crackle {

/// Relative changes of the peak stress and strain above which a companion is considered to follow another branch.
inline constexpr double branch_stress_change = 0.03, branch_strain_change = 0.1;

/// Error of a result, derived from the companions as described above.
/// @param asked  result of the test itself  @param resolution  relative error due to the row spacing
/// @param value  returns the result of a companion
ErrorFigures error_of(double asked, double resolution, const Table<CompanionFigures>& companions,
                      Number CompanionFigures::*value);

/// Whether the companions with another time step or rate reproduce the peak stress and strain. Comparisons with NaN
/// count as false.
bool on_one_branch(const ErrorFigures& stress, const ErrorFigures& strain);

/// Runs the companions of a finished test in memory, as many at a time as the available processors allow. The results
/// state which companions were unstable.
/// @return empty if interrupted, or if the test has no peak
std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks);

}  // namespace crackle
