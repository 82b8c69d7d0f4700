// SPDX-License-Identifier: GPL-3.0-or-later
// Tests means of lines, which have no sense of direction, and the test for a preferred direction.

#include "specimens/statistics/directions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle::directions_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double degree = std::numbers::pi / 180.0;

TEST(Rose, OfLinesOnEitherSideOfTheHorizontalHasAHorizontalMean) {
    Rose rose;
    rose.add(10.0 * degree, 2.0);
    rose.add(170.0 * degree, 1.0);
    rose.add(-10.0 * degree, 1.0);  // the same line
    EXPECT_TRUE(within("mean direction, degrees", std::fmod(rose.mean_direction() + 90.0, 180.0), 90.0, 1e-9));
    EXPECT_TRUE(agrees("resultant", rose.resultant(), std::cos(20.0 * degree), 1e-12));
    EXPECT_EQ(rose.weights[1], 2.0) << "10 degrees belong to the bin that begins there";
    EXPECT_EQ(rose.weights[17], 2.0);
    EXPECT_EQ(rose.count, 3u);
}

TEST(Rose, BinsBeginWhereItSays) {
    Rose from_zero, centred;
    centred.begins = -5.0;
    for (const double angle : {-4.0, 4.0, 6.0, 176.0}) {
        from_zero.add(angle * std::numbers::pi / 180.0, 1.0);
        centred.add(angle * std::numbers::pi / 180.0, 1.0);
    }
    EXPECT_EQ(from_zero.weights[0], 2.0);
    EXPECT_EQ(from_zero.weights[17], 2.0);
    EXPECT_EQ(centred.weights[0], 3.0);
    EXPECT_EQ(centred.weights[1], 1.0);
    EXPECT_EQ(from_zero.mean_direction(), centred.mean_direction());
}

TEST(Rose, MeanTurnsWithTheLines) {
    for (const double turn : {0.0, 37.0, 90.0, 133.0, 179.0}) {
        Rose rose;
        for (const double off : {-20.0, -5.0, 3.0, 22.0}) rose.add((turn + off) * degree, 1.0);
        const double between = std::fmod(rose.mean_direction() - turn + 270.0, 180.0) - 90.0;
        EXPECT_TRUE(within("mean less turn, degrees", between, 0.0, 0.2));
    }
}

TEST(Rose, OfLinesAllRoundHasNoDirection) {
    Rose rose;
    for (int k = 0; k < 18; ++k) rose.add((10.0 * k + 5.0) * degree, 0.3);
    EXPECT_LT(rose.resultant(), 1e-12);
    EXPECT_GT(rose.rayleigh(), 0.99);
    for (const double weight : rose.weights) EXPECT_EQ(weight, 0.3);
}

TEST(Rose, OfNoLinesIsNotANumber) {
    const Rose rose;
    EXPECT_TRUE(std::isnan(rose.mean_direction()) && std::isnan(rose.resultant()) && std::isnan(rose.rayleigh()));
}

TEST(Rose, RayleighRejectsAsOftenAsItStates) {
    constexpr int tries = 4000, lines = 30;
    std::mt19937_64 generator(11);
    int rejected = 0;
    for (int k = 0; k < tries; ++k) {
        Rose rose;
        for (int line = 0; line < lines; ++line) rose.add(uniform_number(generator, 0.0, std::numbers::pi), 1.0);
        if (rose.rayleigh() < 0.05) ++rejected;
    }
    // Three standard deviations of a binomial count, 3 sqrt(4000 0.05 0.95) = 41.
    EXPECT_TRUE(within("of 4000 roses without direction called directed at 5 %", rejected, 200.0, 41.0));
}

TEST(Rose, WithOneLongCrackAmongShortOnesIsOneLine) {
    Rose equal, unequal;
    for (int k = 0; k < 10; ++k) equal.add(20.0 * degree, 1.0);
    unequal.add(20.0 * degree, 1.0);
    for (int k = 0; k < 9; ++k) unequal.add(20.0 * degree, 1e-6);
    EXPECT_LT(equal.rayleigh(), 1e-3);
    EXPECT_GT(unequal.rayleigh(), 0.3) << "one long crack is one line";
}

}  // namespace
}  // namespace crackle::directions_test
