// SPDX-License-Identifier: GPL-3.0-or-later
// Partitions of a rectangle before the inset. Only partition.cpp and, for traces, conforming.cpp use CGAL.
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "mesher/inset.hpp"
#include "mesher/mesher.hpp"

namespace crackle {

/// Checks whether meshing was cancelled. The mesher counts units of work, and every 1024 units the callback is called.
class Patience {
  public:
    /// @param interrupted as in MeshRequest; must outlive this object
    explicit Patience(const std::function<bool()>& interrupted) : interrupted_(interrupted) {}

    /// Call this before each unit of work, for example for one centre or cell. @throws MeshInterrupted
    void piece() {
        if (++pieces_ % pieces_a_question == 0) ask();
    }
    /// Checks immediately; call this before work that takes long. @throws MeshInterrupted
    void ask() const {
        if (interrupted_ && interrupted_()) throw MeshInterrupted();
    }

  private:
    static constexpr std::uint32_t pieces_a_question = 1024;

    const std::function<bool()>& interrupted_;
    std::uint32_t pieces_ = 0;
};

/// Voronoi cells of the domain. Neighbours have identical coordinates at shared corners (equal up to round-off if a
/// centre lies on the boundary).
struct VoronoiCells {
    struct Range {
        std::uint32_t first = 0, count = 0;  // range in `corners`, counter-clockwise
        int centre = -1;
    };
    std::vector<Point> corners;
    std::vector<Range> cells;  // cells and their corners are in spatial order, so that iterating over them is fast

    std::span<const Point> outline(const Range& cell) const {
        return std::span(corners).subspan(cell.first, cell.count);
    }
};

/// Delaunay triangles, counter-clockwise.
struct Triangles {
    std::vector<Point> points;   // centres, and points added on the boundary of the domain, in spatial order
    std::vector<int> centre_of;  // index of each point's centre; -1 for an added point
    std::vector<std::array<int, 3>> corners;     // indices into `points`
    std::vector<std::array<int, 3>> neighbours;  // neighbour across the edge opposite corner k, or -1
    std::vector<std::array<int, 3>>
        traces;  // trace on the edge opposite corner k, or -1; empty in a mesh without traces
};

/// Voronoi cells of centres, which must be finite and inside the domain. @throws MeshError if centres coincide
VoronoiCells voronoi_cells(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience);

/// Delaunay triangles of centres, which must be finite and inside the domain. @throws MeshError if centres coincide
Triangles delaunay_triangles(std::span<const CellCentre> centres, const Rectangle& domain, Boundary boundary,
                             Patience& patience);

/// The points of delaunay_triangles() for Boundary::domain, with the indices of their centres, but no triangles.
/// @throws MeshError if centres coincide
Triangles delaunay_points(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience);

/// Error for two coincident centres.
MeshError coincident_centres(std::span<const CellCentre> centres, int a, int b);

/// Largest coordinate of the domain; position errors are a few times relative_rounding times this value.
double coordinate_scale(const Rectangle& domain);

}  // namespace crackle
