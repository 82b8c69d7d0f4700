// SPDX-License-Identifier: GPL-3.0-or-later
// Partitions of a rectangle before the inset. partition.cpp knows CGAL, and conforming.cpp, where there are traces.
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesher/inset.hpp"
#include "mesher/mesher.hpp"
#include "mesher/patience.hpp"

namespace crackle {

/// Voronoi cells of the domain; neighbours share their corners bit for bit (a centre on the boundary: to rounding).
struct VoronoiCells {
    struct Range {
        std::uint32_t first = 0, count = 0;  // into corners, counter-clockwise
        int centre = -1;
    };
    std::vector<Point> corners;
    std::vector<Range> cells;  // along space, as are their corners: whoever walks them does not wait for memory

    std::span<const Point> outline(const Range& cell) const {
        return std::span(corners).subspan(cell.first, cell.count);
    }
};

/// Delaunay triangles, counter-clockwise.
struct Triangles {
    std::vector<Point> points;                   // centres, and points added on the domain's faces; along space
    std::vector<int> centre_of;                  // by point; -1: added
    std::vector<std::array<int, 3>> corners;     // into points
    std::vector<std::array<int, 3>> neighbours;  // across the edge opposite to corner k; -1: none
    std::vector<std::array<int, 3>> traces;      // on that edge, -1: none; empty of a mesh without traces
};

/// @throws MeshError on coincident centres. The centres are finite and inside the domain.
VoronoiCells voronoi_cells(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience);

/// @throws MeshError on coincident centres. The centres are finite and inside the domain.
Triangles delaunay_triangles(std::span<const CellCentre> centres, const Rectangle& domain, Boundary boundary,
                             Patience& patience);

/// Of the triangles that fill the domain the points alone, with their centres. @throws MeshError as above
Triangles delaunay_points(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience);

/// What two centres at one place are refused with.
MeshError coincident_centres(std::span<const CellCentre> centres, int a, int b);

/// Largest coordinate of the domain: rounding errors of positions are a few relative_rounding of it.
double coordinate_scale(const Rectangle& domain);

}  // namespace crackle
