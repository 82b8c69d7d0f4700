// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a target is judged by the error of the difference of two means, both of which have scatter.

#include "specimens/calibration/judgement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

ReachedTarget target_of(std::span<const double> fresh, std::span<const double> polish) {
    ReachedTarget target;
    target.fresh = mean_of(fresh);
    target.polish = mean_of(polish);
    return target;
}

TEST(Judgement, TheDifferenceOfTwoMeansHasBothErrors) {
    // With equal numbers and scatter, there are 2 (n - 1) = 6 degrees of freedom: t = 2.446912.
    const std::array a{9.0, 10.0, 10.0, 11.0}, b{99.0, 100.0, 100.0, 101.0};
    const double error = std::sqrt(2.0 / 3.0 / 4.0);
    EXPECT_TRUE(
        agrees("half width", difference_half_width(mean_of(a), mean_of(b)), 2.446912 * std::sqrt(2.0) * error, 1e-6));
    // If one sample has no scatter, the degrees of freedom are those of the other, 3: t = 3.182446.
    const std::array exact{5.0, 5.0, 5.0, 5.0};
    EXPECT_TRUE(agrees("half width", difference_half_width(mean_of(a), mean_of(exact)), 3.182446 * error, 1e-6));
    // Three and seven values whose means both have an error of 1: 4/(1/2 + 1/6) = 6 degrees of freedom.
    const double root = std::sqrt(3.0);
    const std::array three{-root, 0.0, root};
    const std::array seven{-3.0, 3.0, -3.0, 3.0, -root, root, 0.0};
    EXPECT_TRUE(agrees("half width of unequal numbers", difference_half_width(mean_of(three), mean_of(seven)),
                       2.446912 * std::sqrt(2.0), 1e-6));
    EXPECT_TRUE(std::isnan(difference_half_width(mean_of(a), mean_of(std::array{1.0}))));
    EXPECT_EQ(difference_half_width(mean_of(exact), mean_of(exact)), 0.0);
}

/// The key is correct: corrected and fresh packings are samples of the same rock. One in twenty may be judged as
/// missed.
TEST(Judgement, ScatterOfEightPackingsIsNoMiss) {
    std::mt19937_64 generator(3);
    constexpr int tries = 400;
    constexpr double value = 100.0, scatter = 15.0;
    int missed = 0;
    for (int k = 0; k < tries; ++k) {
        const auto draw = [&](std::size_t count) {
            std::vector<double> all;
            for (std::size_t n = 0; n < count; ++n)
                all.push_back(scatter *
                              correctly_rounded::normal_quantile(1e-12 + (1.0 - 2e-12) * uniform_number(generator)));
            return all;
        };
        std::vector<double> polish = draw(8), fresh = draw(8);
        // The effect of the correction: the mean of its packings becomes the target.
        const double shift = value - mean_of(polish).mean;
        for (double& one : polish) one += shift;
        for (double& one : fresh) one += shift;
        ReachedTarget target = target_of(fresh, polish);
        judge(target, value, 0.01, {});
        missed += target.verdict == TargetVerdict::missed;
    }
    EXPECT_TRUE(within("share missed by chance", static_cast<double>(missed) / tries, 0.05,
                       3.0 * std::sqrt(0.05 * 0.95 / tries)));
}

TEST(Judgement, IsByToleranceFirstThenByReachThenByChance) {
    const std::array near{99.0, 100.0, 101.0, 100.0}, far{118.0, 120.0, 122.0, 120.0}, wide{80.0, 95.0, 125.0, 140.0};
    const auto verdict = [](std::span<const double> fresh, std::span<const double> polish, const SearchEnd& end) {
        ReachedTarget target = target_of(fresh, polish);
        judge(target, 100.0, 0.01, end);
        return target.verdict;
    };
    EXPECT_EQ(verdict(near, near, {}), TargetVerdict::reached);
    EXPECT_EQ(verdict(far, near, {}), TargetVerdict::missed);
    EXPECT_EQ(verdict(wide, near, {}), TargetVerdict::reached_within_error);
    EXPECT_EQ(verdict(near, near, {.enough = false}), TargetVerdict::unresolved);
    EXPECT_EQ(verdict(wide, near, {.within_reach = false}), TargetVerdict::out_of_reach);
    EXPECT_EQ(verdict(wide, near, {.within_reach = false, .at_rest = false}), TargetVerdict::not_found);
    ReachedTarget target = target_of(far, near);
    judge(target, 100.0, 0.01, {});
    EXPECT_TRUE(agrees("off", target.off, 0.2, 1e-12));
    EXPECT_TRUE(agrees("limit", target.limit, difference_half_width(target.fresh, target.polish) / 100.0, 1e-12));
}

}  // namespace
}  // namespace crackle
