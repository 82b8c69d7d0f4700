// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a piece of a cell merges with a neighbour if the union is convex, and that otherwise the union is divided
// again.

#include "mesher/cell_net.hpp"

#include <algorithm>
#include <utility>

#include "tests/support/claim.hpp"

namespace crackle::cell_net_test {
namespace {

constexpr Point apex{1.5, 1.2};

/// A unit square and a triangle on its right side, whose union has a re-entrant corner at (1, 1).
struct SquareAndTriangle {
    CellNet net{1.0, 0.1, 1e-12};
    int square, triangle;

    explicit SquareAndTriangle(int trace_between) {
        const int a = net.corner_at({0.0, 0.0}), b = net.corner_at({1.0, 0.0}), c = net.corner_at({1.0, 1.0}),
                  d = net.corner_at({0.0, 1.0}), e = net.corner_at(apex);
        square = net.add({{a, b, c, d}, {-1, trace_between, -1, -1}, 0});
        triangle = net.add({{b, e, c}, {-1, -1, trace_between}, 1});
    }
};

TEST(CellNet, DividesAPieceAndItsNeighbourIntoTheMostEqualConvexParts) {
    SquareAndTriangle cells(-1);
    EXPECT_EQ(cells.net.join(cells.triangle), -1) << "the union is not convex";
    ASSERT_TRUE(cells.net.divide_again(cells.triangle, 0.4));
    const double of_square = cells.net.area(cells.net.loop(cells.square)),
                 of_triangle = cells.net.area(cells.net.loop(cells.triangle));
    // A cut from (0, 0) to (1, 1) leaves half of the square as the smaller part; any other cut leaves 0.25 or a concave
    // corner.
    EXPECT_TRUE(testing::agrees("smaller part, m2", std::min(of_square, of_triangle), 0.5, 1e-15));
    EXPECT_TRUE(testing::agrees("both parts, m2", of_square + of_triangle, 1.25, 1e-15));
    for (const int cell : {cells.square, cells.triangle}) EXPECT_TRUE(cells.net.convex(cells.net.loop(cell)));
    EXPECT_EQ(cells.net.loop(cells.square).centre, 0);
    EXPECT_EQ(cells.net.loop(cells.triangle).centre, 1);
}

TEST(CellNet, DividesNothingWhereAPartWouldBeTooSmallOrATraceLiesBetween) {
    for (const auto& [trace, least_area] : {std::pair{-1, 0.6}, {3, 0.1}}) {
        SquareAndTriangle cells(trace);
        EXPECT_FALSE(cells.net.divide_again(cells.triangle, least_area));
        EXPECT_EQ(cells.net.loop(cells.triangle).size(), 3U);
        EXPECT_EQ(cells.net.loop(cells.square).size(), 4U);
    }
}

}  // namespace
}  // namespace crackle::cell_net_test
