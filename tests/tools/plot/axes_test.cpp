// SPDX-License-Identifier: GPL-3.0-or-later
// Tests ticks, units and positions of axes against results by hand.

#include "tools/plot/axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crackle::plot {
namespace {

TEST(Scale, HasTicksUpToBothEnds) {
    const std::vector<double> ticks = Scale{-0.4, 1.0, 0.2}.ticks();
    ASSERT_EQ(ticks.size(), 8u);
    for (std::size_t k = 0; k < ticks.size(); ++k) EXPECT_NEAR(ticks[k], -0.4 + 0.2 * static_cast<double>(k), 1e-15);
}

TEST(Scale, StepsByOneTwoOrFiveTimesAPowerOfTen) {
    for (const auto& [largest, step] : {std::pair{0.5, 0.1}, {0.9, 0.2}, {1.2, 0.5}, {4.9, 1.0}, {900.0, 200.0}})
        EXPECT_NEAR(scale_for(0.0, largest, 5).step, step, 1e-12 * step) << largest;
}

TEST(Unit, HasThePrefixThatPutsTheLargestBetweenOneAndAThousand) {
    for (const auto& [largest, factor, name] : {std::tuple{3e9, 1e9, "GN/m"},
                                                {3e6, 1e6, "MN/m"},
                                                {3e3, 1e3, "kN/m"},
                                                {3.0, 1.0, "N/m"},
                                                {-3e-3, 1e-3, "mN/m"}}) {
        const Unit unit = unit_for(largest, "N/m");
        EXPECT_EQ(unit.factor, factor);
        EXPECT_EQ(unit.name, name);
    }
    EXPECT_EQ(unit_for(3e6, "N/m or Pa").name, "MN/m or MPa");
}

TEST(Scale, LeavesOutZeroWhereTheValuesLieFarFromIt) {
    for (const auto& [low, high] : {std::pair{10.0, 11.0}, {-11.0, -10.0}}) {
        const Scale scale = scale_around(low, high, 5);
        EXPECT_LT(scale.low, low);
        EXPECT_GT(scale.low, low - 0.1 * (high - low)) << low;
        EXPECT_GT(scale.high, high);
        EXPECT_LT(scale.high, high + 0.1 * (high - low)) << high;
        EXPECT_GE(scale.ticks().size(), 4U);
    }
    for (const auto& [low, high] : {std::pair{1.0, 11.0}, {0.0, 2.0}, {7.0, 7.0}})
        EXPECT_EQ(scale_around(low, high, 5).low, 0.0);
    EXPECT_GE(scale_around(-11.0, -1.0, 5).high, 0.0);
    const Scale both = scale_around(-1.0, 2.0, 5);
    EXPECT_LT(both.low, -1.0);
    EXPECT_GT(both.high, 2.0);
}

TEST(Unit, ThatTakesNoPrefixHasAPowerOfAThousand) {
    for (const auto& [largest, factor, name] : {std::tuple{3.2e7, 1e6, "10⁶ dyn"},
                                                {1.5e4, 1e3, "10³ dyn"},
                                                {9.9e3, 1.0, "dyn"},
                                                {-0.02, 1.0, "dyn"},
                                                {4e-5, 1e-6, "10⁻⁶ dyn"},
                                                {2e13, 1e12, "10¹² dyn"},
                                                {0.0, 1.0, "dyn"}}) {
        const Unit unit = unit_with_power(largest, "dyn");
        EXPECT_NEAR(unit.factor, factor, 1e-12 * factor) << largest;
        EXPECT_EQ(unit.name, name) << largest;
    }
    EXPECT_EQ(unit_with_power(2e5, "").name, "10³") << "steps";
}

TEST(Axes, HaveTheirLowEndsAtTheLeftAndTheBottom) {
    const Axes axes{{10.0, 20.0, 100.0, 50.0}, {0.0, 2.0, 1.0}, {-1.0, 4.0, 1.0}};
    const Point low = axes.at(0.0, -1.0), high = axes.at(2.0, 4.0), between = axes.at(0.5, 0.0);
    EXPECT_EQ((std::pair{low.x, low.y}), (std::pair{10.0, 70.0}));
    EXPECT_EQ((std::pair{high.x, high.y}), (std::pair{110.0, 20.0}));
    EXPECT_EQ((std::pair{between.x, between.y}), (std::pair{35.0, 60.0}));
}

TEST(Axes, TheNumberAtTheLastTickStaysWithinThePanel) {
    const Canvas canvas(1.0, 1.0, Format::svg, {});
    constexpr double room = 100.0;
    for (const Scale& x :
         {Scale{-8.0, -4.0, 1.0}, Scale{-8.0, -3.98, 1.0}, Scale{-8.0, -3.2, 1.0}, Scale{0.0, 1e4, 1e4}}) {
        const double right = Axes::room_right(canvas, x, room);
        const Axes axes{{0.0, 0.0, room - right, 50.0}, x, {0.0, 1.0, 1.0}};
        const double last = x.ticks().back();
        const double end = axes.at(last, 0.0).x + 0.5 * canvas.size_of(x.label(last)).width;
        EXPECT_LE(end, room + 1e-9) << x.label(last);
        EXPECT_TRUE(right == 4.0 || end > room - 1e-9) << "no other output: " << x.label(last);
    }
}

}  // namespace
}  // namespace crackle::plot
