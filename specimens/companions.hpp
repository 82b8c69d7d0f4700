// SPDX-License-Identifier: GPL-3.0-or-later
// How far the numbers of a test depend on how it was computed: the same test again at half the time step, half the
// loading rate, half and double the damping.
//
// A specimen that breaks follows one of many branches, and which one a rounding decides; so the peaks of companions
// differ by chance as well as by the error of step and rate. With s the sample standard deviation of the three values x
// (as asked), x at half the step and x at half the rate, the stated error is t·sqrt(2)·s, t = 4.303 the 97.5 % point of
// Student's distribution with two degrees of freedom: by chance 95 of 100 further runs, at a rate as slow as one likes,
// lie within. Where nothing branches and the error is linear in the rate, x differs from its limit by e and from its
// companion by e/2, and the stated error is 1.8 e. What the damping changes is physics as much as error and stands
// apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "specimens/virtual_test.hpp"

namespace crackle {

struct Companion {
    std::string name;  ///< "half_time_step", "half_rate", "half_damping", "double_damping"
    double peak_stress = 0.0, peak_strain = 0.0;
    bool failed = false;
    std::int64_t steps = 0;
    double post_peak_difference = 0.0;  ///< mean |stress - the test's| from the peak on, over the peak
};

/// Relative errors of one number.
struct NumberError {
    double time_step = 0.0, rate = 0.0, damping = 0.0;  ///< largest change by the companions
    double stated = 0.0;
};

struct NumericalErrors {
    std::vector<Companion> companions;
    NumberError peak_stress, peak_strain;
    bool peak_converged = false;  ///< no companion by step or rate is on another branch
};

/// A companion whose peak moved by more than this is on another branch.
inline constexpr double branch_stress_change = 0.03, branch_strain_change = 0.1;

/// Runs the companions of a finished test in memory, as many at a time as there are processors.
/// @return nothing if interrupted, or the test has no peak
std::optional<NumericalErrors> run_companions(const VirtualTest& test, const TestHooks& hooks);

}  // namespace crackle
