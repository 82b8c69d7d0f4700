// SPDX-License-Identifier: GPL-3.0-or-later
// Confidence interval of a median for any distribution, since timings have a tail on one side only.
//
// The k-th smallest and the k-th largest of n independent values enclose the distribution's median, unless fewer than k
// of the values fall on one side of it. Both sides are equally likely, so the probability is 1 - 2·P(B(n, ½) < k). The
// largest k with at least 95 % is used: for 15 values the fourth smallest and the fourth largest, with 96.5 %.
#pragma once

#include <vector>

namespace crackle::throughput {

/// Median of one or more values; for an even number of values, the mean of the middle two.
double median(std::vector<double> values);

struct MedianInterval {
    double median, low, high;
};

/// With fewer values there is no such interval: the smallest and the largest of five enclose the median in only 93.75 %
/// of all cases.
inline constexpr int fewest_for_interval = 6;

/// @throws InputError for fewer than fewest_for_interval values
MedianInterval median_interval(std::vector<double> values);

}  // namespace crackle::throughput
