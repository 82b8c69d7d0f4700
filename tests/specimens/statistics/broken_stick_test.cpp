// SPDX-License-Identifier: GPL-3.0-or-later
// Tests where a curve or a count changes its slope: for curves with a known break, and for random counts as often as
// stated.

#include "specimens/statistics/broken_stick.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle::broken_stick_test {
namespace {

using testing::agrees;
using testing::within;

TEST(BrokenStick, OfTwoLinesIsWhereTheyMeet) {
    for (const double s : {0.31, 0.5, 0.777}) {
        std::vector<double> x, y;
        for (int k = 0; k <= 100; ++k) {
            x.push_back(2e6 + 1e6 * 0.01 * k);
            y.push_back(40.0 + 3e-6 * x.back() + 2e-4 * std::max(0.0, x.back() - (2e6 + s * 1e6)));
        }
        const BrokenStick found = fit_broken_stick(x, y);
        EXPECT_TRUE(agrees("the break", found.at, 2e6 + s * 1e6, 1e-6));
        EXPECT_TRUE(agrees("slope below", found.slope_below, 3e-6, 1e-3));
        EXPECT_TRUE(agrees("slope above", found.slope_above, 2.03e-4, 1e-5));
    }
}

TEST(BrokenStick, OfFewerThanFivePointsIsNotANumber) {
    const std::vector<double> few{0.0, 1.0, 2.0, 3.0};
    EXPECT_TRUE(std::isnan(fit_broken_stick(few, few).at));
}

/// Random events over stresses from 0 to 1: up to s at 2 % of the later rate, then at that rate.
std::vector<Burst> random_bursts(double s, double rate, std::mt19937_64& generator) {
    std::vector<Burst> bursts;
    double x = 0.0;
    while (true) {
        // An exponential waiting time, at the rate of the interval in which it falls.
        double wait = -std::log1p(-uniform_number(generator)) / rate;
        if (x < s) {
            const double slow = std::min(wait / 0.02, s - x);
            x += slow;
            wait -= 0.02 * slow;
            if (wait <= 0.0) {
                bursts.push_back({x, 1});
                continue;
            }
        }
        x += wait;
        if (x >= 1.0) return bursts;
        bursts.push_back({x, 1});
    }
}

TEST(BurstBreak, LiesInItsIntervalAsOftenAsStated) {
#ifdef __SANITIZE_ADDRESS__
    constexpr int tries = 20;  // with sanitizers, each takes half a second
#else
    constexpr int tries = 200;
#endif
    std::mt19937_64 generator(7);
    int covered = 0;
    double sum = 0.0;
    for (int k = 0; k < tries; ++k) {
        const double s = uniform_number(generator, 0.35, 0.65);
        const BurstBreak found = find_burst_break(random_bursts(s, 400.0, generator), 1.0);
        if (found.low <= s && s <= found.high) ++covered;
        sum += found.at - s;
    }
    // Three standard deviations of a binomial count.
    const double spread = 3.0 * std::sqrt(0.95 * 0.05 * tries);
    EXPECT_TRUE(within("of all known breaks in their interval", covered, 0.95 * tries, spread));
    // The error of a single break is about 10 of the 400 bursts.
    EXPECT_TRUE(within("mean distance from the known break", sum / tries, 0.0, 10.0 / 400.0 / std::sqrt(tries)));
}

TEST(BurstBreak, OfFewBurstsIsNotANumber) {
    std::vector<Burst> bursts(fewest_bursts - 1, {0.5, 100});
    EXPECT_TRUE(std::isnan(find_burst_break(bursts, 1.0).at));
    for (std::size_t k = 0; k < bursts.size(); ++k) bursts[k].x = 0.1 * static_cast<double>(k);
    bursts.push_back({2.0, 1});  // after the end
    EXPECT_TRUE(std::isnan(find_burst_break(bursts, 1.0).at));
}

TEST(BurstBreak, IsTheSameOfTheSameBursts) {
    std::mt19937_64 generator(3);
    const std::vector<Burst> bursts = random_bursts(0.5, 100.0, generator);
    const BurstBreak one = find_burst_break(bursts, 1.0), other = find_burst_break(bursts, 1.0);
    EXPECT_EQ(one.low, other.low);
    EXPECT_EQ(one.high, other.high);
    EXPECT_LT(one.low, one.high);
}

}  // namespace
}  // namespace crackle::broken_stick_test
