// SPDX-License-Identifier: GPL-3.0-or-later
// Fits two straight lines that meet, to find where a curve changes its slope:
//       y = a + b x + c max(0, x - s)
// The parameters a, b, c and s are found by least squares (Hudson, J. Am. Stat. Assoc. 61, 1966). For counts that grow
// in bursts, the confidence interval of s is found by resampling the bursts.
// Tested by tests/specimens/statistics/broken_stick_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace crackle {

/// Two lines that meet. Slopes are in units of y per unit of x.
struct BrokenStick {
    double at = std::numeric_limits<double>::quiet_NaN();  ///< the value x = s at which the lines meet
    double slope_below = std::numeric_limits<double>::quiet_NaN();
    double slope_above = std::numeric_limits<double>::quiet_NaN();
};

/// Fits two lines; NaN for fewer than five points. @param x  ascending values @param y  one value for each x
BrokenStick fit_broken_stick(std::span<const double> x, std::span<const double> y);

/// Several events that occur together, at the same x.
struct Burst {
    double x;
    std::int64_t count;
};

/// Value at which the slope of a cumulative count changes, with its 95 % interval.
struct BurstBreak {
    double at = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

/// Smallest number of bursts for which a change of slope is determined.
inline constexpr std::size_t fewest_bursts = 10;

/// Finds the value between 0 and `end` at which the slope of the cumulative count changes. The count is evaluated at
/// 200 equally spaced values. The ends of the 95 % interval are percentiles of 1,000 bootstrap fits. Each fit uses a
/// sample with the same number of bursts, drawn with replacement. The same bursts always give the same interval. The
/// result is NaN if there are too few bursts.
/// @param bursts  bursts in any range; bursts beyond `end` are ignored
BurstBreak find_burst_break(std::span<const Burst> bursts, double end);

}  // namespace crackle
