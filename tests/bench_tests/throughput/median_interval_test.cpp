// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the confidence interval of a median: its ranks for tabulated sample sizes, and how often it contains the true
// median.

#include "tests/bench/throughput/median_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle::throughput {
namespace {

/// The numbers 1 to n in mixed order.
std::vector<double> numbers_to(int n) {
    std::vector<double> values;
    for (int k = 0; k < n; ++k) values.push_back(1.0 + (7 * k + 3) % n);
    return values;
}

TEST(MedianInterval, HasTheRanksOfTheBinomialTables) {
    struct Known {
        int n;
        double low;  // rank of the lower bound, as tabulated for the sign test at 5 %
    };
    for (const Known& known : {Known{6, 1}, {8, 1}, {9, 2}, {11, 2}, {12, 3}, {15, 4}, {20, 6}, {25, 8}, {100, 40}}) {
        const MedianInterval interval = median_interval(numbers_to(known.n));
        EXPECT_EQ(interval.low, known.low) << known.n;
        EXPECT_EQ(interval.high, known.n + 1 - known.low) << known.n;
        EXPECT_EQ(interval.median, 0.5 * (known.n + 1)) << known.n;
    }
}

TEST(MedianInterval, GoesOnWhereAHalfToTheNumberOfValuesIsZero) {
    const MedianInterval interval = median_interval(numbers_to(10001));
    // By the normal approximation, half the interval is 1.96·√n/2 ranks wide.
    EXPECT_NEAR(interval.low, 5001.0 - 0.98 * std::sqrt(10001.0), 1.0);
}

TEST(MedianInterval, RefusesSoFewValuesThatNoneEncloseIt) {
    EXPECT_THROW(median_interval(numbers_to(5)), InputError);
    EXPECT_NO_THROW(median_interval(numbers_to(6)));
}

TEST(MedianInterval, HoldsTheMedianOfASkewDistributionAsOftenAsItSays) {
    std::mt19937_64 generator(1);
    constexpr int trials = 20000;
    int held = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(15);
        for (double& value : values) value = std::pow(-std::log(1.0 - uniform_number(generator)), 3.0);
        const MedianInterval interval = median_interval(values);
        const double median = std::pow(std::log(2.0), 3.0);
        held += interval.low <= median && median <= interval.high ? 1 : 0;
    }
    const double share = static_cast<double>(held) / trials;
    std::printf("expected 0.9648, got %.4f\n", share);
    EXPECT_NEAR(share, 0.9648, 4.0 * std::sqrt(0.9648 * 0.0352 / trials));
}

}  // namespace
}  // namespace crackle::throughput
