// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the inset of one convex polygon against closed forms.

#include "mesher/inset.hpp"

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

std::vector<Point> inset(const std::vector<Point>& outline, double depth) {
    Inset work(depth, 1.0);
    const auto result = work.of(outline);
    return {result.begin(), result.end()};
}

TEST(Inset, SquareShrinksByTwiceTheDepth) {
    const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(inset(square, 0.125),
              (std::vector<Point>{{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}}));
    EXPECT_EQ(inset(square, 0.0), square);
}

TEST(Inset, TriangleLivesUpToItsInscribedRadius) {
    const std::vector<Point> triangle{{0, 0}, {0.4, 0}, {0, 0.3}};  // 3-4-5: r = 0.1
    EXPECT_TRUE(agrees("inscribed radius", inscribed_radius(triangle, 1.0), 0.1, 1e-5));
    EXPECT_EQ(inset(triangle, 0.0999).size(), 3U);
    EXPECT_TRUE(inset(triangle, 0.1001).empty());
    // The inset is similar to the triangle about its incentre, with ratio 1 - d/r.
    const auto half = inset(triangle, 0.05);
    EXPECT_TRUE(agrees("area at half the radius", testing::area_of(half), 0.25 * 0.06, 1e-12));
}

TEST(Inset, NeedleIsInsetAlongBothLongEdges) {
    const double height = 1e-4;
    const std::vector<Point> needle{{0, 0}, {1, -0.5 * height}, {1, 0.5 * height}};
    const auto result = inset(needle, 0.2 * height);
    ASSERT_EQ(result.size(), 3U);
    for (const Point& p : result) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point a = needle[k], b = needle[(k + 1) % 3];
            EXPECT_GT(testing::cross(a, b, p) / std::hypot(b.x - a.x, b.y - a.y), 0.2 * height - 1e-15);
        }
    }
}

TEST(Inset, ShortEdgeVanishesWithoutMovingTheOthers) {
    // A square with a corner cut off by 0.01: at a depth of 0.1 the half-plane of the cut has no effect any more.
    const std::vector<Point> cut{{0, 0}, {1, 0}, {1, 0.99}, {0.99, 1}, {0, 1}};
    const auto result = inset(cut, 0.1);
    ASSERT_EQ(result.size(), 4U);
    EXPECT_TRUE(agrees("area", testing::area_of(result), 0.64, 1e-14));
    // At a depth of 0.01 it still has an effect: each end of the edge loses tan(22.5 degrees) times the depth.
    const auto shallow = inset(cut, 0.01);
    ASSERT_EQ(shallow.size(), 5U);
    EXPECT_TRUE(agrees("length of the cut", std::hypot(shallow[3].x - shallow[2].x, shallow[3].y - shallow[2].y),
                       0.01 * (std::sqrt(2.0) - 2.0 * std::tan(0.39269908169872414)), 1e-12));
}

TEST(Inset, StraightCornerIsNone) {
    const std::vector<Point> outline{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto result = inset(outline, 0.1);
    ASSERT_EQ(result.size(), 4U);
    EXPECT_TRUE(agrees("area", testing::area_of(result), 0.64, 1e-14));
}

TEST(Inset, StraightCornerThatIsKeptIsOneAndConvex) {
    // A trace ends in the middle of the lower edge, so this flat corner is kept; the one in the upper edge is dropped.
    const std::vector<Point> square{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0, 1}};
    const std::vector<char> kept{0, 1, 0, 0, 0, 0};
    for (const double depth : {0.0, 0.125}) {
        Inset work(depth, 1.0);
        const auto result = work.of(square, kept);
        ASSERT_EQ(result.size(), 5U) << depth;
        EXPECT_TRUE(within("place along the edge", result[1].x, 0.5, 1e-12));
        EXPECT_TRUE(within("place off it", result[1].y, depth, 1e-14));
        const Point in{result[1].x - result[0].x, result[1].y - result[0].y},
            out{result[2].x - result[1].x, result[2].y - result[1].y};
        EXPECT_GT(cross(in, out), 0.0) << "the solver treats the union as convex";
    }
}

TEST(Inset, EveryPointIsAtLeastTheDepthFromEveryEdge) {
    testing::Dice dice(5);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<Point> outline;
        double angle = 0.0;
        while ((angle += 0.02 + 1.2 * dice.next()) < 6.28)
            outline.push_back({0.3 * std::cos(angle), 0.2 * std::sin(angle)});
        const double depth = 0.3 * dice.next();
        const auto result = inset(outline, depth);
        const double radius = inscribed_radius(outline, 1.0);
        EXPECT_EQ(result.empty(), !(depth < radius)) << "depth " << depth << ", inscribed radius " << radius;
        for (const Point& p : result) {
            double nearest = 1.0;
            for (std::size_t k = 0; k < outline.size(); ++k) {
                const Point a = outline[k], b = outline[(k + 1) % outline.size()];
                nearest = std::min(nearest, testing::cross(a, b, p) / std::hypot(b.x - a.x, b.y - a.y));
            }
            EXPECT_NEAR(nearest, depth, 1e-12);  // the smallest distance is found at corners
        }
    }
}

}  // namespace
}  // namespace crackle
