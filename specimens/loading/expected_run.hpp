// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the duration of a test before it begins, and rejects tests that would take impractically long.
// Tested by tests/specimens/loading/expected_run_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Number of steps and run time in seconds up to an axial strain, including unloading, at the strain rate that the case
/// gives. If a tolerance controls the rate, it is the initial rate.
struct RunEstimate {
    double strain = 0.0;
    double steps = 0.0, seconds = 0.0;
};

/// Estimates the run of a prepared test up to `strain`.
/// @param steps_per_second  measured speed, or that of roughly_steps_per_second()
RunEstimate expected_run(const VirtualTest& test, double strain, double steps_per_second);

/// Steps per second of a test on a typical processor of 2020, to within a factor of three.
double roughly_steps_per_second(const VirtualTest& test);

/// Number of steps, and run time in s, above which a test is rejected as endless.
inline constexpr double most_steps = 1e10, most_seconds = 86400.0;

/// @throws InputError if reaching max_axial_strain would exceed most_steps or most_seconds; the message names the key
/// that causes it
void refuse_endless(const VirtualTest& test, const RunEstimate& run);

/// Rejects a test that would step forever at zero strain: the first step must move the driving part by more than
/// round-off. A speed set by the caller may be 0.
/// @param test  test at the start of loading @throws InputError naming the key that determines the speed
void refuse_resting(const VirtualTest& test);

}  // namespace crackle
