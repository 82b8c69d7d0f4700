// SPDX-License-Identifier: GPL-3.0-or-later
// What several packings say of a figure: mean, scatter, and how sure the mean is.
// Tested by tests/specimens/statistics/mean_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// Of fewer values the bootstrap cannot leave their range; Student's t does.
inline constexpr std::size_t fewest_of_bootstrap = 8;

/// Of values that are independent draws. What is not defined (a deviation of one value) is not a number.
struct MeanFigure {
    std::size_t count = 0;
    double mean = std::numeric_limits<double>::quiet_NaN();
    double deviation = std::numeric_limits<double>::quiet_NaN();       ///< sample standard deviation, n - 1
    double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< of the mean
    /// 95 % interval of the mean. Of 8 to 200 values: percentiles of 10,000 bootstrap means, at the levels that are as
    /// wide as Student's t (expanded percentile interval, Hesterberg, Am. Stat. 69, 2015). Of fewer, whose bootstrap
    /// cannot leave their range, and of more, where both agree: Student's t. The same values give the same interval.
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();

    double variation() const { return deviation / mean; }  ///< coefficient of variation
};
MeanFigure mean_of(std::span<const double> values);

/// Half of the 95 % interval of the difference of two means of independent values: Student's t with Welch's degrees of
/// freedom (Biometrika 34, 1947). Not a number where one has less than two values.
double difference_half_width(const MeanFigure& a, const MeanFigure& b);

/// What a mean is wrong by because time goes in steps and the platens move at a rate, from companions of the same
/// packings at half the step and half the rate. A first-order error is twice the change at half of it (Richardson);
/// that is taken for both: of the step it is an upper bound where leapfrog's second order prevails (4/3 of the change).
/// The three runs of a packing belong together, and the errors are those of their sum. In units of the figure,
/// positive: the mean is too large.
struct MeanBias {
    std::size_t packings = 0;  ///< that have all three
    double step = std::numeric_limits<double>::quiet_NaN(), step_error = std::numeric_limits<double>::quiet_NaN();
    double rate = std::numeric_limits<double>::quiet_NaN(), rate_error = std::numeric_limits<double>::quiet_NaN();
    double value = std::numeric_limits<double>::quiet_NaN();  ///< of both
    double standard_error = std::numeric_limits<double>::quiet_NaN();

    /// Whether one of the three lies beyond the 95 % interval of nothing, by Student's t.
    bool known() const;
};
/// @param asked, half_step, half_rate  of the same packings in the same order
MeanBias bias_of(std::span<const double> asked, std::span<const double> half_step, std::span<const double> half_rate);

/// Between sorted values, linear (type 7 of Hyndman and Fan, Am. Stat. 50, 1996). @param sorted at least one value
/// @param share 0 to 1
double percentile(std::span<const double> sorted, double share);

/// Share below and above that percentiles of bootstrap means of so many values leave out, to be as wide as Student's t.
double expanded_tail(std::size_t count);

/// Packings that bring a standard error down to a goal: (deviation/goal)², at least 2.
double packings_for(double deviation, double goal);

}  // namespace crackle
