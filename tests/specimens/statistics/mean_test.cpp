// SPDX-License-Identifier: GPL-3.0-or-later
// Tests means and their errors against closed forms, and how often intervals contain the true value.

#include "specimens/statistics/mean.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

std::vector<double> normal_values(std::size_t count, double mean, double deviation, std::mt19937_64& generator) {
    const boost::math::normal standard;
    std::vector<double> values;
    for (std::size_t k = 0; k < count; ++k)
        values.push_back(mean + deviation * boost::math::quantile(standard, uniform_number(generator, 1e-12, 1.0)));
    return values;
}

TEST(MeanFigure, OfFiveValuesByHand) {
    const MeanFigure m = mean_of(std::array{2.0, 4.0, 4.0, 5.0, 10.0});
    EXPECT_EQ(m.count, 5U);
    EXPECT_TRUE(agrees("mean", m.mean, 5.0, 1e-15));
    EXPECT_TRUE(agrees("deviation", m.deviation, 3.0, 1e-15));
    EXPECT_TRUE(agrees("standard error", m.standard_error, 3.0 / std::sqrt(5.0), 1e-15));
    EXPECT_TRUE(agrees("coefficient of variation", m.variation(), 0.6, 1e-15));
    EXPECT_TRUE(agrees("lower end of the interval, t = 2.776", m.low, 5.0 - 2.776445 * 3.0 / std::sqrt(5.0), 1e-6));
    const MeanFigure again = mean_of(std::array{2.0, 4.0, 4.0, 5.0, 10.0});
    EXPECT_EQ(m.low, again.low) << "the same values give the same interval";
}

TEST(MeanFigure, OfOneValueKnowsNoScatterAndOfNoneNoMean) {
    const MeanFigure one = mean_of(std::array{3.0});
    EXPECT_EQ(one.mean, 3.0);
    EXPECT_TRUE(std::isnan(one.deviation) && std::isnan(one.low));
    EXPECT_TRUE(std::isnan(mean_of({}).mean));
}

// For 400 samples, a fraction of 0.95 has a standard error of 0.011.
TEST(MeanFigure, IntervalHoldsTheMeanInNineteenOfTwentySamples) {
    std::mt19937_64 generator(7);
    for (const std::size_t count : {2U, 3U, 5U, 10U, 40U, 300U}) {
        int held = 0;
        constexpr int samples = 400;
        for (int k = 0; k < samples; ++k) {
            const MeanFigure m = mean_of(normal_values(count, 100.0, 15.0, generator));
            held += m.low <= 100.0 && 100.0 <= m.high ? 1 : 0;
        }
        fmt::print("  {} values: the interval held the mean in {:.3f} of {} samples\n", count,
                   static_cast<double>(held) / samples, samples);
        EXPECT_NEAR(static_cast<double>(held) / samples, 0.95, 0.035);  // three standard errors
    }
}

TEST(MeanBias, IsTwiceTheChangeAndItsErrorThatOfTheSum) {
    // x = x0 + a h + b v, requested at h = v = 1; each packing has its own x0, and the companions have noise.
    const double a = 0.3, b = -0.2;
    std::vector<double> asked, step, rate;
    for (const double packing : {10.0, 12.0, 15.0}) {
        asked.push_back(packing + a + b);
        step.push_back(packing + a / 2.0 + b);
        rate.push_back(packing + a + b / 2.0);
    }
    const MeanBias exact = bias_of(asked, step, rate);
    EXPECT_EQ(exact.packings, 3U);
    EXPECT_TRUE(agrees("bias by the step", exact.step, a, 1e-12));
    EXPECT_TRUE(agrees("bias by the rate", exact.rate, b, 1e-12));
    EXPECT_TRUE(agrees("bias", exact.value, a + b, 1e-12));
    EXPECT_TRUE(exact.known());
    // One packing's requested run is on another branch: both differences contain this, and the errors add up fully.
    asked[1] += 0.6;
    const MeanBias shaken = bias_of(asked, step, rate);
    const double each = 2.0 * 0.6 / 3.0;  // standard error of {0, 1.2, 0}
    EXPECT_TRUE(agrees("error by the step", shaken.step_error, each, 1e-12));
    EXPECT_TRUE(agrees("error of the sum", shaken.standard_error, 2.0 * each, 1e-12));
    EXPECT_FALSE(shaken.known()) << "three packings are too few to show it";
    EXPECT_FALSE(bias_of(std::array{1.0}, std::array{2.0}, std::array{3.0}).known());
}

TEST(MeanBias, KnowsPartsThatCancel) {
    const std::array asked{10.0, 10.1, 9.9}, step{9.0, 9.1, 8.9}, rate{11.0, 11.1, 10.9};
    const MeanBias bias = bias_of(asked, step, rate);
    EXPECT_NEAR(bias.value, 0.0, 1e-12);
    EXPECT_TRUE(bias.known());
}

TEST(MeanBias, ErrorOfEachPartIsItsOwn) {
    // Twice the changes are 1, 2, 3 for the step and 4, 1, 4 for the rate; their sums are 5, 3, 7.
    const std::array asked{4.0, 5.0, 9.0}, step{3.5, 4.0, 7.5}, rate{2.0, 4.5, 7.0};
    const MeanBias bias = bias_of(asked, step, rate);
    EXPECT_TRUE(agrees("by the step", bias.step, 2.0, 1e-12));
    EXPECT_TRUE(agrees("its error", bias.step_error, 1.0 / std::sqrt(3.0), 1e-12));
    EXPECT_TRUE(agrees("by the rate", bias.rate, 3.0, 1e-12));
    EXPECT_TRUE(agrees("its error", bias.rate_error, 1.0, 1e-12));
    EXPECT_TRUE(agrees("of both", bias.value, 5.0, 1e-12));
    EXPECT_TRUE(agrees("its error", bias.standard_error, 2.0 / std::sqrt(3.0), 1e-12));
}

TEST(Packings, ForAGoalGrowWithTheSquareOfTheScatter) {
    EXPECT_EQ(packings_for(0.16, 0.05), 11.0);
    EXPECT_EQ(packings_for(0.16, 0.02), 64.0);
    EXPECT_EQ(packings_for(0.16, 0.01), 256.0);
    EXPECT_EQ(packings_for(0.01, 1.0), 2.0);
}

}  // namespace
}  // namespace crackle
