// SPDX-License-Identifier: GPL-3.0-or-later
// Faces and sides close the outline of every cell, whatever the inset.

#include "solver/faces/find_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

FaceNet faces_of(const CellBox& box) { return find_faces(outlines_before_inset(build_box(box).world, box.gap)); }

using testing::agrees;
using testing::within;

/// For each cell Σ L n and Σ L (c - x)·n over its faces and sides, with x its centroid.
struct Outline {
    Vec2 closing;
    double twice_area = 0.0;
};

std::vector<Outline> outlines_of(const FaceNet& net) {
    std::vector<Outline> outlines(net.cells.size());
    const auto add = [&](BodyIndex b, Vec2 middle, Vec2 normal, double length) {
        outlines[b].closing = outlines[b].closing + length * normal;
        outlines[b].twice_area += length * dot(middle - net.cells[b].centroid, normal);
    };
    for (const SharedFace& face : net.faces) {
        add(face.i, face.middle, face.normal, face.length);
        add(face.j, face.middle, -1.0 * face.normal, face.length);
    }
    for (const FreeSide& side : net.sides) add(side.body, side.middle, side.normal, side.length);
    return outlines;
}

void expect_closed(const CellBox& box) {
    const FaceNet net = faces_of(box);
    double open = 0.0, area = 0.0, area_error = 0.0;
    const std::vector<Outline> outlines = outlines_of(net);
    for (std::size_t b = 0; b < outlines.size(); ++b) {
        open = std::max(open, norm(outlines[b].closing));
        area += net.cells[b].area;
        area_error = std::max(area_error, std::abs(outlines[b].twice_area - 2.0 * net.cells[b].area));
    }
    EXPECT_TRUE(within("sum of L n over faces and sides of a cell, m", open, 0.0, 1e-12));
    EXPECT_TRUE(within("sum of L a less twice the area, m2", area_error, 0.0, 1e-12));
    EXPECT_TRUE(within("area of all cells, m2", area, box.width * box.height, 1e-12));
}

TEST(FindFaces, CloseTheOutlineOfEveryVoronoiCell) { expect_closed({}); }

TEST(FindFaces, CloseTheOutlineOfEveryTriangle) {
    expect_closed({.kind = MeshKind::delaunay, .columns = 6, .rows = 6});
}

TEST(FindFaces, DoNotDependOnTheInset) {
    // Wide gaps take short edges away; what is left of a cell then has a corner in their place.
    CellBox box{.lloyd = 20};
    const FaceNet narrow = faces_of(box);
    box.gap = 0.002;
    const FaceNet wide = faces_of(box);
    double total = 0.0, of_wide = 0.0;
    for (const SharedFace& face : narrow.faces) total += face.length;
    for (const SharedFace& face : wide.faces) of_wide += face.length;
    EXPECT_TRUE(within("faces that the inset took away", static_cast<double>(wide.faces.size()),
                       static_cast<double>(narrow.faces.size()), 3.0));
    EXPECT_TRUE(agrees("length of all faces", of_wide, total, 1e-3));
}

TEST(FindFaces, ShareALongEdgeAmongTwoShortOnes) {
    CellBox box{.width = 2.0, .height = 1.0, .gap = 0.0};
    Mesh mesh;
    const auto add = [&](double x1, double x2, double y1, double y2) {
        mesh.cells.push_back({static_cast<std::uint32_t>(mesh.corners.size()), 4});
        for (const Point corner : {Point{x1, y1}, Point{x2, y1}, Point{x2, y2}, Point{x1, y2}})
            mesh.corners.push_back(corner);
    };
    add(0.0, 1.0, 0.0, 1.0);
    add(1.0, 2.0, 0.0, 0.3);
    add(1.0, 2.0, 0.3, 1.0);
    const FaceNet net = find_faces(outlines_before_inset(world_of(box, mesh, {}).world, 0.0));
    std::vector<double> lengths;
    for (const SharedFace& face : net.faces) lengths.push_back(face.length);
    std::ranges::sort(lengths);
    ASSERT_EQ(lengths.size(), 3u);
    EXPECT_TRUE(within("short face, m", lengths[0], 0.3, 1e-15));
    EXPECT_TRUE(within("the other, m", lengths[1], 0.7, 1e-15));
    double free = 0.0;
    for (const FreeSide& side : net.sides) free += side.length;
    EXPECT_TRUE(within("free sides, m", free, 6.0, 1e-14));
}

}  // namespace
}  // namespace crackle::verification
