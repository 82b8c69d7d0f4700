// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a destroyed triangle is merged only with a neighbour with which it is convex.

#include "mesher/merge.hpp"

#include <set>

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

TEST(JoinDestroyed, PassesOverANeighbourWithWhichItIsNotConvex) {
    // A needle 0-1-2. With triangle 0-2-3 across its longest edge, the angle at 2 would exceed 180 degrees; with 1-0-4
    // the union is convex.
    Triangles mesh;
    mesh.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.01}, {1.3, 0.5}, {0.5, -0.5}};
    mesh.corners = {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}};
    mesh.neighbours = {{-1, 1, 2}, {-1, -1, 0}, {-1, -1, 0}};
    const JoinedTriangles joined = join_destroyed(mesh, {0}, 0.02, 1.0);
    EXPECT_EQ(joined.joined, (std::vector<bool>{true, false, true}));
    ASSERT_EQ(joined.outlines.size(), 1U);
    EXPECT_EQ(joined.outlines[0].triangle, 0);
    // The corners are 0, 4, 1, 2, counter-clockwise, starting at any of them.
    auto corners = joined.outlines[0].corners;
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), 0), corners.end());
    EXPECT_EQ(corners, (std::vector<int>{0, 4, 1, 2}));
}

/// A needle 0-1-2 with a neighbour across each of its long edges, of which 0-2 is slightly longer than 0-1. The union
/// with either is convex.
Triangles needle_between(Point beyond_longest, Point beyond_next) {
    Triangles mesh;
    mesh.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.01}, beyond_longest, beyond_next};
    mesh.corners = {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}};
    mesh.neighbours = {{-1, 1, 2}, {-1, -1, 0}, {-1, -1, 0}};
    return mesh;
}

TEST(JoinDestroyed, JoinsAcrossItsLongestEdge) {
    const JoinedTriangles joined = join_destroyed(needle_between({0.5, 0.5}, {0.5, -0.5}), {0}, 0.02, 1.0);
    EXPECT_EQ(joined.joined, (std::vector<bool>{true, true, false}));
}

TEST(JoinDestroyed, PassesOverANeighbourWithWhichItIsStillDestroyed) {
    const JoinedTriangles joined = join_destroyed(needle_between({0.5, 0.012}, {0.5, -0.5}), {0}, 0.02, 1.0);
    EXPECT_EQ(joined.joined, (std::vector<bool>{true, false, true}));
}

TEST(JoinDestroyed, RefusesASliverThatIsConvexWithNone) {
    // Corner 2 lies almost on edge 0-1, so no union with a triangle above is convex; 1-0-3 below has an angle of 177
    // degrees at 1.
    Triangles mesh;
    mesh.points = {{0.0, 0.0}, {1.0, 0.0}, {0.9, 0.01}, {2.0, -0.05}, {0.4, 0.5}, {1.2, 0.5}};
    mesh.corners = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 5}};
    mesh.neighbours = {{3, 2, 1}, {-1, -1, 0}, {-1, -1, 0}, {-1, -1, 0}};
    EXPECT_THROW(join_destroyed(mesh, {0}, 0.02, 1.0), MeshError);
}

TEST(JoinDestroyed, GoesOnUntilTheJoinedPolygonSurvives) {
    // Three strips, each destroyed by the inset, that together form a rectangle which survives.
    Triangles mesh;
    for (int k = 0; k < 4; ++k) {
        mesh.points.push_back({0.0, 0.01 * k});
        mesh.points.push_back({1.0, 0.01 * k});
    }
    for (int k = 0; k < 3; ++k) {
        const int a = 2 * k, b = a + 1, c = a + 2, d = a + 3;
        mesh.corners.push_back({a, b, d});
        mesh.neighbours.push_back({-1, 2 * k + 1, k > 0 ? 2 * k - 1 : -1});
        mesh.corners.push_back({a, d, c});
        mesh.neighbours.push_back({k < 2 ? 2 * k + 2 : -1, -1, 2 * k});
    }
    const JoinedTriangles joined = join_destroyed(mesh, {0, 1, 2, 3, 4, 5}, 0.012, 1.0);
    ASSERT_EQ(joined.outlines.size(), 1U);
    std::vector<Point> outline;
    for (const int corner : joined.outlines[0].corners)
        outline.push_back(mesh.points[static_cast<std::size_t>(corner)]);
    EXPECT_TRUE(testing::agrees("area of the joined polygon", testing::area_of(outline), 0.03, 1e-14));
    EXPECT_EQ(std::count(joined.joined.begin(), joined.joined.end(), true), 6);
}

}  // namespace
}  // namespace crackle
