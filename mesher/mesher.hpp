// SPDX-License-Identifier: GPL-3.0-or-later
// Polygon particles from centres: Delaunay triangles or Voronoi cells of a rectangle, each inset so that neighbours
// stand apart.
//   centres -> partition of the rectangle -> every polygon moved inwards by `inset` along every edge, domain faces
//   included
// Facing edges of neighbours are then 2·inset apart; the default inset thick/2 makes every gap the segment thickness.
// Lengths in m (any consistent unit). Follows volonoi.f of the DEMseg guide; where it departs, the declarations below
// say so.
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace crackle {

/// A place in the plane, m.
struct Point {
    double x = 0.0;
    double y = 0.0;

    friend bool operator==(const Point&, const Point&) = default;
};

/// m. Not std::hypot(), whose last digit differs from processor to processor.
inline double distance(Point a, Point b) {
    const double x = b.x - a.x, y = b.y - a.y;
    return std::sqrt(x * x + y * y);
}

/// m2. Of places taken as vectors.
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Centre from which a cell grows: a circle centre of a packing.
using CellCentre = Point;

/// The domain to be partitioned, m.
struct Rectangle {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
};

enum class MeshKind : std::uint8_t { delaunay, voronoi };

/// How Delaunay triangles end at the domain; Voronoi cells always fill the domain.
enum class Boundary : std::uint8_t {
    domain,   ///< centres next to a wall are also projected onto it and the corners added: flat faces, areas sum to the
              ///< domain's
    centres,  ///< only triangles between three centres (the guide's): 2n - 2 - h, h centres along the outer chain
};

struct MeshRequest {
    MeshKind kind = MeshKind::voronoi;
    Boundary boundary = Boundary::domain;
    double mesh_gap = 0.0;        ///< m, >= 0: gap between facing edges
    std::optional<double> inset;  ///< m, >= 0: depth by which each edge moves inwards; thick/2 where absent
    /// Cells that the inset destroys: false, an error; true, Voronoi: the centre is left out and its neighbours take
    /// its place; Delaunay: the triangle joins a neighbour with which it is convex (an error where there is none).
    bool merge_destroyed = false;
    /// Where the cells end in place of the domain, which it lies in: convex, counter-clockwise, all centres inside. A
    /// Voronoi cell is cut by it. Of triangles its corners are points like the centres, along its sides more of them
    /// about a mean spacing apart, and centres nearer to it than a third of one are left out, for triangles with them
    /// would be slivers.
    std::vector<Point> outline;
    /// Traces of joints, points one after another, in the domain or on its boundary: edges of the cells follow them.
    /// Meshes that fill the domain have them, without an outline, and Voronoi cells without merging. An end as near to
    /// another trace or a wall as trace_reach_share of the mean spacing goes to it along its own line. Where
    /// traces are too close for Voronoi cells of their own they cut cells, which are cut whole; a tip that would leave
    /// less than 0.15 of a cut on either side of it moves.
    std::vector<std::vector<Point>> traces;
    /// Asked now and then, by the thread that meshes; true ends it by MeshInterrupted.
    std::function<bool()> interrupted;
};

inline constexpr double trace_reach_share = 0.25;
inline constexpr double smallest_piece_share = 0.05;  ///< of the mean cell

/// Sides of the domain, as bits of Cell::sides.
enum SideBit : std::uint8_t { side_left = 1, side_right = 2, side_bottom = 4, side_top = 8 };

/// A convex polygon, counter-clockwise after the inset.
struct Cell {
    std::uint32_t first_corner = 0;  ///< into Mesh::corners
    std::uint32_t corner_count = 0;
    /// Voronoi: index of its centre, of a cell that a trace made of the nearest one; triangles: -1
    int centre = -1;
    std::array<int, 3> centres{-1, -1,
                               -1};  ///< triangles: centres at the corners, -1 for a corner added on the domain's face
    double area = 0.0;               ///< m2, before the inset
    std::uint8_t sides = 0;          ///< SideBit: domain faces on which the cell had an edge before the inset

    bool on_left() const { return (sides & side_left) != 0; }
    bool on_right() const { return (sides & side_right) != 0; }
    bool on_bottom() const { return (sides & side_bottom) != 0; }
    bool on_top() const { return (sides & side_top) != 0; }
};

struct MeshReport {
    std::int64_t centres = 0;
    std::int64_t cells = 0;
    std::int64_t segments = 0;         ///< sum of the cells' edges
    double shortest_edge = 0.0;        ///< m, after the inset
    double smallest_angle = 0.0;       ///< degrees, interior, after the inset
    std::int64_t cells_destroyed = 0;  ///< by the inset, all of them merged
    double area_before_inset = 0.0;    ///< m2, sum over the cells
    double area_after_inset = 0.0;     ///< m2
    // Of a mesh with traces:
    std::int64_t trace_edges = 0;   ///< edges of cells on traces, both sides, after the inset
    double trace_length = 0.0;      ///< m, of the edges on traces before the inset, each once
    std::int64_t ends_moved = 0;    ///< ends of traces that went on to another trace or a wall, or back to it
    double largest_move = 0.0;      ///< m
    double coincident = 0.0;        ///< m along which traces lie on others, whose edges are the first one's
    std::int64_t centres_left = 0;  ///< centres that made way for traces
    std::int64_t points_added = 0;  ///< corners inside that no centre is
    // Of Voronoi cells, where traces are too close for cells of their own:
    std::int64_t cells_cut = 0;      ///< by traces
    std::int64_t pieces_joined = 0;  ///< smaller than smallest_piece_share of the mean cell, joined to a neighbour
};

struct Mesh {
    std::vector<Point> corners;  ///< of all cells, numbered along space
    std::vector<Cell> cells;     ///< Voronoi: in the order of the centres; triangles: along space
    /// By corner: the trace, into MeshRequest::traces, on which the edge to the cell's next corner lies; -1: none.
    /// Empty of a mesh without traces.
    std::vector<int> edge_traces;
    MeshReport report;

    std::span<const Point> outline(const Cell& cell) const {
        return std::span(corners).subspan(cell.first_corner, cell.corner_count);
    }
};

/// How well shaped cells are.
struct MeshQuality {
    double smallest_angle = 0.0;  ///< degrees
    double smallest_area = 0.0;   ///< of a cell over their mean, before the inset
    double shortest_edge = 0.0;   ///< over their mean, after the inset
};
MeshQuality quality_of(const Mesh& mesh);

/// Centres, traces or a request from which no mesh can be made. `centres` and `traces` hold the indices it names, if
/// any.
class MeshError : public std::runtime_error {
  public:
    explicit MeshError(const std::string& text, std::vector<int> named_centres = {}, std::vector<int> named_traces = {})
        : std::runtime_error(text), centres(std::move(named_centres)), traces(std::move(named_traces)) {}

    std::vector<int> centres, traces;
};

/// The caller does not want the mesh any more.
class MeshInterrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted while meshing"; }
};

/// Partitions `domain` and insets every cell. Same input, same bytes.
/// @param centres  inside the domain or on its boundary, no two coincident
/// @throws MeshError no, coincident, outside or NaN centres; no area; bad thick or inset; no triangle; a destroyed cell
/// @throws MeshInterrupted
/// Cost: two to three times CGAL's bare insertion of the centres (tests/benchmarks/meshing.cpp); as much again for each
/// round in which Voronoi cells are merged.
Mesh make_mesh(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request);

}  // namespace crackle
