// SPDX-License-Identifier: GPL-3.0-or-later
// Tests cells clipped to a convex outline within the domain.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesher/mesher.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

std::vector<Point> disc(int sides, double radius) {
    std::vector<Point> outline;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / sides;
        outline.push_back({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)});
    }
    return outline;
}

/// Randomly displaced grid points within a circle slightly inside the outline.
std::vector<CellCentre> centres(int count, double radius) {
    std::mt19937_64 generator(7);
    std::vector<CellCentre> all;
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            const auto random = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5; };
            const Point p{(i + 0.5 + 0.5 * random()) / count, (j + 0.5 + 0.5 * random()) / count};
            if (std::hypot(p.x - 0.5, p.y - 0.5) < radius) all.push_back(p);
        }
    }
    return all;
}

TEST(Outline, CellsFillItAndNoCornerLiesBeyond) {
    constexpr double radius = 0.45;
    constexpr int sides = 60;
    const double area = 0.5 * sides * radius * radius * std::sin(2.0 * std::numbers::pi / sides);
    for (const MeshKind kind : {MeshKind::voronoi, MeshKind::delaunay}) {
        MeshRequest request;
        request.kind = kind;
        request.outline = disc(sides, radius);
        const std::vector<CellCentre> seeds = centres(30, 0.99 * radius * std::cos(std::numbers::pi / sides));
        const Mesh mesh = make_mesh(seeds, {0.0, 1.0, 0.0, 1.0}, request);
        // The tolerance is for about a thousand rounding errors of numbers below 1.
        EXPECT_TRUE(agrees("area of the cells", mesh.report.area_before_inset, area, 1e-12));
        for (const Point& corner : mesh.corners)
            ASSERT_LE(std::hypot(corner.x - 0.5, corner.y - 0.5), radius * (1.0 + 1e-12));
        double least = 1.0;
        for (const Cell& cell : mesh.cells) least = std::min(least, cell.area);
        EXPECT_GT(least, 0.02 / (30.0 * 30.0)) << "no slivers";
        if (kind == MeshKind::voronoi) {
            EXPECT_EQ(mesh.cells.size(), seeds.size());
        }
    }
}

TEST(Outline, WhatIsNoneOrLeavesCentresOutsideIsRefused) {
    MeshRequest request;
    request.outline = {{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.2}, {0.5, 0.9}};
    EXPECT_THROW(make_mesh(std::vector<CellCentre>{{0.5, 0.15}}, {0.0, 1.0, 0.0, 1.0}, request), MeshError);
    request.outline = disc(20, 0.3);
    EXPECT_THROW(make_mesh(std::vector<CellCentre>{{0.5, 0.5}, {0.9, 0.9}}, {0.0, 1.0, 0.0, 1.0}, request), MeshError);
}

}  // namespace
}  // namespace crackle
