// SPDX-License-Identifier: GPL-3.0-or-later
// Means and their errors against closed forms, and how often intervals hold what they promise.

#include "specimens/campaign/statistics.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/packing/random_numbers.hpp"
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
    EXPECT_TRUE(m.low < 5.0 && m.high > 5.0 && m.low >= 2.0 && m.high <= 10.0);
    const MeanFigure again = mean_of(std::array{2.0, 4.0, 4.0, 5.0, 10.0});
    EXPECT_EQ(m.low, again.low) << "the same values give the same interval";
}

TEST(MeanFigure, OfOneValueKnowsNoScatterAndOfNoneNoMean) {
    const MeanFigure one = mean_of(std::array{3.0});
    EXPECT_EQ(one.mean, 3.0);
    EXPECT_TRUE(std::isnan(one.deviation) && std::isnan(one.low));
    EXPECT_TRUE(std::isnan(mean_of({}).mean));
}

// 400 samples: a share of 0.95 has a standard error of 0.011.
TEST(MeanFigure, IntervalHoldsTheMeanInNineteenOfTwentySamples) {
    std::mt19937_64 generator(7);
    for (const std::size_t count : {std::size_t{5}, std::size_t{10}, std::size_t{40}}) {
        int held = 0;
        constexpr int samples = 400;
        for (int k = 0; k < samples; ++k) {
            const MeanFigure m = mean_of(normal_values(count, 100.0, 15.0, generator));
            held += m.low <= 100.0 && 100.0 <= m.high ? 1 : 0;
        }
        fmt::print("  {} values: the interval held the mean in {:.3f} of {} samples\n", count,
                   static_cast<double>(held) / samples, samples);
        // Few values make a bootstrap too narrow even at expanded levels: 0.91 of five.
        EXPECT_NEAR(static_cast<double>(held) / samples, 0.95, count < 10 ? 0.06 : 0.035);
    }
}

TEST(MeanBias, IsRichardsonsOfStepAndRate) {
    // x(h) = x0 + a h², asked at h: x0 + a; half: x0 + a/4; the bias is a = 4/3 of the difference. Of the rate
    // x = x0 + b v: b = twice the difference.
    const double a = 0.3, b = -0.2;
    std::vector<double> step, rate;
    for (const double packing : {0.0, 0.01, -0.01}) {
        step.push_back(a - a / 4.0 + packing);
        rate.push_back(b - b / 2.0 + packing);
    }
    const MeanBias bias = bias_of(step, rate);
    EXPECT_EQ(bias.pairs, 3U);
    EXPECT_TRUE(agrees("bias by the step", bias.step, a, 1e-12));
    EXPECT_TRUE(agrees("bias by the rate", bias.rate, b, 1e-12));
    EXPECT_TRUE(agrees("bias", bias.value(), a + b, 1e-12));
    const double each = 0.01 / std::sqrt(3.0);
    EXPECT_TRUE(agrees("its standard error", bias.standard_error(), std::hypot(4.0 / 3.0 * each, 2.0 * each), 1e-12));
    EXPECT_TRUE(bias.known());
}

TEST(Packings, ForAGoalGrowWithTheSquareOfTheScatter) {
    EXPECT_EQ(packings_for(0.16, 0.05), 11.0);
    EXPECT_EQ(packings_for(0.16, 0.02), 64.0);
    EXPECT_EQ(packings_for(0.16, 0.01), 256.0);
    EXPECT_EQ(packings_for(0.01, 1.0), 2.0);
}

}  // namespace
}  // namespace crackle
