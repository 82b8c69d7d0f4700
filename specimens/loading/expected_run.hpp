// SPDX-License-Identifier: GPL-3.0-or-later
// How long a test will take before it has begun, so that none is without an end in sight.
// Tested by tests/specimens/loading/expected_run_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Steps and seconds up to an axial strain, at the first rate.
struct RunEstimate {
    double strain = 0.0;
    double steps = 0.0, seconds = 0.0;
};

/// @param test prepared @param steps_per_second as measured, or roughly_steps_per_second()
RunEstimate expected_run(const VirtualTest& test, double strain, double steps_per_second);

/// What a processor of 2020 does, of circles or polygons, within a factor of three.
double roughly_steps_per_second(const VirtualTest& test);

/// Beyond these a test has no end in sight.
inline constexpr double most_steps = 1e10, most_seconds = 86400.0;

/// @throws InputError if max_axial_strain is that far away, naming the key that makes it so.
void refuse_endless(const VirtualTest& test, const RunEstimate& run);

/// The one check that no test of any kind steps for ever at a strain of 0: its first step moves the driving part, which
/// a part at rest does not do, nor a speed below the last digit of its place. A caller's own speed may be 0.
/// @param test at the start of its loading @throws InputError naming the key that the speed comes from
void refuse_resting(const VirtualTest& test);

}  // namespace crackle
