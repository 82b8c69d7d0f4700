// SPDX-License-Identifier: GPL-3.0-or-later
// What several packings say of a figure: mean, scatter, and how sure the mean is.
// Tested by tests/specimens/campaign/statistics_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// Of values that are independent draws. What is not defined (a deviation of one value) is not a number.
struct MeanFigure {
    std::size_t count = 0;
    double mean = std::numeric_limits<double>::quiet_NaN();
    double deviation = std::numeric_limits<double>::quiet_NaN();       ///< sample standard deviation, n - 1
    double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< of the mean
    /// 95 % interval of the mean: percentiles of 10,000 bootstrap means, at the levels that are as wide for few values
    /// as Student's t (expanded percentile interval, Hesterberg, Am. Stat. 69, 2015). The same values give the same
    /// interval.
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();

    double variation() const { return deviation / mean; }  ///< coefficient of variation
};
MeanFigure mean_of(std::span<const double> values);

/// What a mean is wrong by because time goes in steps and the platens move at a rate, from companions of the same
/// packings at half the step and half the rate, in pairs: of two grids at an order p the coarse one errs by
/// 2^p/(2^p - 1) times their difference (Richardson): 4/3 for the step (leapfrog, second order), 2 for the rate
/// (inertia and dashpots, first order). In units of the figure, positive: the mean is too large.
struct MeanBias {
    std::size_t pairs = 0;  ///< the smaller number of the two kinds
    double step = std::numeric_limits<double>::quiet_NaN(), step_error = std::numeric_limits<double>::quiet_NaN();
    double rate = std::numeric_limits<double>::quiet_NaN(), rate_error = std::numeric_limits<double>::quiet_NaN();

    double value() const { return step + rate; }
    double standard_error() const;
    /// Whether it is more than two standard errors from none.
    bool known() const;
};
/// @param step_pairs, rate_pairs  as asked less half, of each packing that has both
MeanBias bias_of(std::span<const double> step_differences, std::span<const double> rate_differences);

/// Packings that bring a standard error down to a goal: (deviation/goal)², at least 2.
double packings_for(double deviation, double goal);

}  // namespace crackle
