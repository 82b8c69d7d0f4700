// SPDX-License-Identifier: GPL-3.0-or-later
// Two straight lines that meet: where a curve changes its slope.
//     y = a + b x + c max(0, x - s)
// by least squares over a, b, c and s (Hudson, J. Am. Stat. Assoc. 61, 1966). For counts that grow in bursts the
// interval of s comes from drawing the bursts again.
// Tested by tests/specimens/statistics/broken_stick_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace crackle {

struct BrokenStick {
    double at = std::numeric_limits<double>::quiet_NaN();  ///< s
    double slope_below = std::numeric_limits<double>::quiet_NaN();
    double slope_above = std::numeric_limits<double>::quiet_NaN();
};

/// @param x ascending @param y as many. Of fewer than five points: not a number.
BrokenStick fit_broken_stick(std::span<const double> x, std::span<const double> y);

/// So many at once, at x.
struct Burst {
    double x;
    std::int64_t count;
};

struct BurstBreak {
    double at = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

/// Fewer bursts than this have no break.
inline constexpr std::size_t fewest_bursts = 10;

/// Where the cumulative count changes its slope between 0 and `end`, with a 95 % interval: percentiles of 1,000 fits to
/// as many bursts drawn with replacement. The count is read at 200 equally spaced places. The same bursts give the same
/// interval. Of too few bursts: not a number.
/// @param bursts those beyond `end` are left out
BurstBreak find_burst_break(std::span<const Burst> bursts, double end);

}  // namespace crackle
