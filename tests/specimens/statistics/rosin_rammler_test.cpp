// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a known law of sizes is recovered from its samples.

#include "specimens/statistics/rosin_rammler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle::rosin_rammler_test {
namespace {

using testing::agrees;
using testing::within;

TEST(RosinRammler, OfPiecesByTheLawGivesItsParametersBack) {
    // Pieces whose sizes divide the area into equal parts: quantiles of the law, truncated below.
    for (const double n : {0.7, 1.5, 3.0}) {
        constexpr double x0 = 0.02, least = 0.004;
        constexpr int pieces = 4000;
        std::vector<double> sizes, areas;
        const double share_above = std::exp(-std::pow(least / x0, n));
        for (int k = 0; k < pieces; ++k) {
            const double share = share_above * (k + 0.5) / pieces;  // fraction of the area in larger pieces
            sizes.push_back(x0 * std::pow(-std::log(share), 1.0 / n));
            areas.push_back(1e-4);
        }
        const RosinRammler found = fit_rosin_rammler(sizes, areas, least);
        // The largest of 4000 quantiles represents the tail, which causes an error of about 1/4000 of its logarithm.
        EXPECT_TRUE(agrees("exponent", found.exponent, n, 5e-3));
        EXPECT_TRUE(agrees("size, m", found.size, x0, 5e-3));
        EXPECT_EQ(found.pieces, 4000u);
    }
}

TEST(RosinRammler, CountsAPieceByItsArea) {
    // The distribution is weighted by area, so two pieces of half the area equal one piece.
    std::vector<double> sizes, areas, split_sizes, split_areas;
    for (int k = 1; k <= 20; ++k) {
        sizes.push_back(0.01 * k);
        areas.push_back(1.0);
        for (int half = 0; half < 2; ++half) {
            split_sizes.push_back(0.01 * k);
            split_areas.push_back(0.5);
        }
    }
    // A maximum is found to half the digits, 1.5e-8.
    const RosinRammler one = fit_rosin_rammler(sizes, areas, 0.005),
                       other = fit_rosin_rammler(split_sizes, split_areas, 0.005);
    EXPECT_TRUE(agrees("exponent", other.exponent, one.exponent, 1e-7));
    EXPECT_TRUE(agrees("size", other.size, one.size, 1e-7));
}

TEST(RosinRammler, OfFewOrAlikePiecesIsNotANumber) {
    const std::vector<double> four{1.0, 2.0, 3.0, 4.0}, alike(10, 2.0), weights(10, 1.0);
    EXPECT_TRUE(std::isnan(fit_rosin_rammler(four, std::span(weights).first(4), 0.5).exponent));
    EXPECT_TRUE(std::isnan(fit_rosin_rammler(alike, weights, 0.5).exponent));
    EXPECT_EQ(fit_rosin_rammler(alike, weights, 3.0).pieces, 0u) << "all are below the smallest";
}

TEST(MedianSize, HasHalfOfTheAreaInSmallerPieces) {
    const std::vector<double> sizes{4.0, 1.0, 2.0}, areas{2.0, 1.0, 1.0};
    EXPECT_TRUE(agrees("of 1 + 1 + 2 the second ends at half", median_size(sizes, areas), 2.0, 1e-12));
    const std::vector<double> more{1.0, 1.0, 4.0};
    EXPECT_TRUE(agrees("half way through the second, linear", median_size(sizes, more), 1.5, 1e-12));
    EXPECT_TRUE(std::isnan(median_size({}, {})));
}

}  // namespace
}  // namespace crackle::rosin_rammler_test
