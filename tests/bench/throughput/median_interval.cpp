// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/median_interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"

namespace crackle::throughput {
namespace {

constexpr double outside = 0.05;

/// Largest k with 2·P(B(n, ½) < k) <= 5 %. @param n at least fewest_for_interval
std::size_t rank_of_bound(std::size_t n) {
    // Logarithms are used because 2^-n underflows to 0 for n >= 1075.
    const auto count = static_cast<double>(n);
    const double whole = std::lgamma(count + 1.0) - count * std::log(2.0);
    double below = 0.0;  // P(B < k + 1)
    std::size_t k = 0;
    while (true) {
        const auto successes = static_cast<double>(k);
        below += std::exp(whole - std::lgamma(successes + 1.0) - std::lgamma(count - successes + 1.0));
        if (2.0 * below > outside) return k;
        ++k;
    }
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

MedianInterval median_interval(std::vector<double> values) {
    const std::size_t n = values.size();
    if (n < static_cast<std::size_t>(fewest_for_interval))
        throw InputError(fmt::format("median: found {} values, expected at least {} for an interval of 95 %", n,
                                     fewest_for_interval));
    std::sort(values.begin(), values.end());
    const std::size_t k = rank_of_bound(n);
    return {median(values), values[k - 1], values[n - k]};
}

}  // namespace crackle::throughput
