// SPDX-License-Identifier: GPL-3.0-or-later
// How far a median can be trusted, whatever the distribution: timings have tails on one side.
//
// The k-th smallest and the k-th largest of n independent values enclose the distribution's median, unless fewer than k
// of the values fall on one side of it. Each side is as likely as that of a coin, so the probability is 1 - 2·P(B(n, ½)
// < k). The largest k that leaves 95 % is taken: for 15 values the fourth smallest and the fourth largest, 96.5 %.
#pragma once

#include <vector>

namespace crackle::throughput {

/// Median of at least one value; for an even number the mean of the two in the middle.
double median(std::vector<double> values);

struct MedianInterval {
    double median, low, high;
};

/// Fewer values have no such interval: the smallest and the largest of five enclose the median in 93.75 % of all cases.
inline constexpr int fewest_for_interval = 6;

/// @throws InputError for fewer than fewest_for_interval values
MedianInterval median_interval(std::vector<double> values);

}  // namespace crackle::throughput
