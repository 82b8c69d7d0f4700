// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a result over several packings: mean, scatter, and the error of the mean.
// Tested by tests/specimens/statistics/mean_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// Smallest number of values for the bootstrap. With fewer values, Student's t is used, because bootstrap means always
/// lie within the small range of the values.
inline constexpr std::size_t fewest_of_bootstrap = 8;

/// Mean of independent values. Members that are undefined, such as the deviation of a single value, are NaN.
struct MeanFigure {
    std::size_t count = 0;
    double mean = std::numeric_limits<double>::quiet_NaN();
    double deviation = std::numeric_limits<double>::quiet_NaN();       ///< sample standard deviation, with n - 1
    double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< standard error of the mean
    /// 95 % interval of the mean. For 8 to 200 values, it consists of percentiles of 10,000 bootstrap means, at levels
    /// for which the interval is as wide as Student's t (expanded percentile interval, Hesterberg, Am. Stat. 69, 2015).
    /// Student's t is used for fewer values, because bootstrap means always lie within their small range, and for more
    /// values, because both methods then agree. The same values give the same interval.
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();

    double variation() const { return deviation / mean; }  ///< coefficient of variation
};
/// Mean, deviation and interval of values. @param values  independent values; if there are none, the results are NaN
MeanFigure mean_of(std::span<const double> values);

/// Half-width of the 95 % interval of the difference between two means of independent values, from Student's t with
/// Welch's degrees of freedom (Biometrika 34, 1947). NaN if either mean is taken over fewer than 2 values.
double difference_half_width(const MeanFigure& a, const MeanFigure& b);

/// Errors of a mean due to the time step and the loading rate, in the unit of the mean; positive if the mean is too
/// large. They are estimated from companion runs of the same packings at half the step and at half the rate. A
/// first-order error is twice the change that halving causes (Richardson). This estimate is used for both errors. For
/// the step it is an upper bound: if the second-order error of leapfrog dominates, the error is 4/3 of the change.
/// Standard errors take into account that the three runs of a packing belong together.
struct MeanBias {
    std::size_t packings = 0;  ///< number of packings with a test and both companion runs
    double step = std::numeric_limits<double>::quiet_NaN(), step_error = std::numeric_limits<double>::quiet_NaN();
    double rate = std::numeric_limits<double>::quiet_NaN(), rate_error = std::numeric_limits<double>::quiet_NaN();
    double value = std::numeric_limits<double>::quiet_NaN();  ///< sum of `step` and `rate`
    double standard_error = std::numeric_limits<double>::quiet_NaN();

    /// Whether at least one of the three errors differs significantly from zero (95 %, Student's t).
    bool known() const;
};
/// Estimates the bias of a mean. @param asked, half_step, half_rate  values of the same packings, in the same order
MeanBias bias_of(std::span<const double> asked, std::span<const double> half_step, std::span<const double> half_rate);

/// Percentile by linear interpolation between sorted values (type 7 of Hyndman and Fan, Am. Stat. 50, 1996).
/// @param sorted  at least one value
/// @param share  0 to 1
double percentile(std::span<const double> sorted, double share);

/// Fraction of the bootstrap means to cut off at each end, so that the interval is as wide as Student's t interval for
/// `count` values.
double expanded_tail(std::size_t count);

/// Number of packings that reduces the standard error to `goal`: (deviation/goal)², at least 2.
double packings_for(double deviation, double goal);

}  // namespace crackle
