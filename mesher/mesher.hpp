// SPDX-License-Identifier: GPL-3.0-or-later
// Polygonal particles from centres: Delaunay triangles or Voronoi cells of a rectangle, inset so that neighbours do not
// touch. First the rectangle is partitioned, then every edge of every polygon is moved inwards by `inset`, also at the
// boundary of the domain. Facing edges of neighbours are then 2·inset apart; the default inset thick/2 makes every gap
// equal to the segment thickness. Lengths are in m (or any other consistent unit). Follows volonoi.f of the DEMseg
// guide; differences are stated at the declarations below.
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

/// A point in the plane, m.
struct Point {
    double x = 0.0;
    double y = 0.0;

    friend bool operator==(const Point&, const Point&) = default;
};

/// Distance between two points, m. std::hypot() is not used, because its last digit differs between processors.
inline double distance(Point a, Point b) {
    const double x = b.x - a.x, y = b.y - a.y;
    return std::sqrt(x * x + y * y);
}

/// Cross product of two points as position vectors, m2.
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
/// Scalar product of two points as position vectors, m2.
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Point around which a cell is formed, for example the centre of a circle in a packing.
using CellCentre = Point;

/// The domain to be partitioned, m.
struct Rectangle {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
};

/// Kind of the cells: Delaunay triangles between the centres, or Voronoi cells around them.
enum class MeshKind : std::uint8_t { delaunay, voronoi };

/// How Delaunay triangles meet the boundary of the domain. Voronoi cells always fill the domain.
enum class Boundary : std::uint8_t {
    domain,   ///< centres next to a wall are also projected onto it, and points are added in the corners; walls are
              ///< straight, and the areas sum to that of the domain
    centres,  ///< only triangles between three centres, as in the DEMseg guide: 2n - 2 - h triangles for n centres, h
              ///< of them on the outer boundary
};

/// Request for a mesh; lengths in m.
struct MeshRequest {
    MeshKind kind = MeshKind::voronoi;
    Boundary boundary = Boundary::domain;
    double mesh_gap = 0.0;        ///< m, >= 0: distance between facing edges
    std::optional<double> inset;  ///< m, >= 0: distance by which each edge moves inwards; mesh_gap/2 if not set
    /// Whether cells that the inset destroys are removed by merging; otherwise they are an error. The centre of a
    /// destroyed Voronoi cell is omitted, and the neighbours fill the space. A destroyed Delaunay triangle is merged
    /// with a neighbour if the union is convex; it is an error if there is no such neighbour.
    bool merge_destroyed = false;
    /// Boundary of the cells instead of the domain: a convex, counter-clockwise outline within the domain, with all
    /// centres inside. Voronoi cells are clipped to it. For triangles, its corners are used as points, with further
    /// points along its sides at about the mean spacing. Centres closer to the outline than a third of the mean spacing
    /// are then omitted, since their triangles would be slivers.
    std::vector<Point> outline;
    /// Traces of joints, which cell edges follow. Each is a list of consecutive points in the domain or on its
    /// boundary. Traces require a mesh that fills the domain, without an outline, and for Voronoi cells without
    /// merging. An end closer than trace_reach_share of the mean spacing to another trace or a wall is extended to it
    /// along its own line. Traces that are too close together for rows of Voronoi cells cut through whole cells. A
    /// trace end is then moved if it would leave less than 0.15 of a cut on either side.
    std::vector<std::vector<Point>> traces;
    /// Called from time to time by the meshing thread. If it returns true, meshing stops and throws MeshInterrupted.
    std::function<bool()> interrupted;
};

inline constexpr double trace_reach_share = 0.25;
inline constexpr double smallest_piece_share =
    0.05;  ///< smallest area of a piece of a cut cell, relative to the mean cell area

/// Sides of the domain, as bits in Cell::sides.
enum SideBit : std::uint8_t { side_left = 1, side_right = 2, side_bottom = 4, side_top = 8 };

/// A cell of the mesh: a convex polygon whose corners after the inset are stored counter-clockwise.
struct Cell {
    std::uint32_t first_corner = 0;  ///< index of the cell's first corner in Mesh::corners
    std::uint32_t corner_count = 0;
    /// For Voronoi cells, the index of the cell's centre, or of the nearest centre if the cell was added along a trace.
    /// For triangles, -1.
    int centre = -1;
    std::array<int, 3> centres{
        -1, -1, -1};         ///< triangles: indices of the centres at the corners; -1 for a point added on the boundary
    double area = 0.0;       ///< area before the inset, m2
    std::uint8_t sides = 0;  ///< SideBits of the sides of the domain on which the cell had an edge before the inset

    /// Whether the cell had an edge on the left side of the domain before the inset.
    bool on_left() const { return (sides & side_left) != 0; }
    /// Whether the cell had an edge on the right side.
    bool on_right() const { return (sides & side_right) != 0; }
    /// Whether the cell had an edge on the bottom side.
    bool on_bottom() const { return (sides & side_bottom) != 0; }
    /// Whether the cell had an edge on the top side.
    bool on_top() const { return (sides & side_top) != 0; }
};

/// Counts, sizes and quality of a mesh.
struct MeshReport {
    std::int64_t centres = 0;
    std::int64_t cells = 0;
    std::int64_t segments = 0;         ///< total number of edges of all cells
    double shortest_edge = 0.0;        ///< length of the shortest edge after the inset, m
    double smallest_angle = 0.0;       ///< degrees, interior angle after the inset
    std::int64_t cells_destroyed = 0;  ///< number of cells destroyed by the inset, all of which were merged
    double area_before_inset = 0.0;    ///< m2, sum over all cells
    double area_after_inset = 0.0;     ///< m2
    // The following members are set only for meshes with traces.
    std::int64_t trace_edges = 0;  ///< number of cell edges on traces after the inset, counting both sides of a trace
    double trace_length =
        0.0;  ///< m, total length of traces covered by edges before the inset; each part of a trace counts once
    /// Number of trace ends that were extended or shortened to meet another trace or a wall.
    std::int64_t ends_moved = 0;
    double largest_move = 0.0;  ///< m, largest displacement of a trace end
    double coincident =
        0.0;  ///< m, length along which traces coincide; edges there belong to the trace with the lowest index
    std::int64_t centres_left = 0;  ///< number of centres omitted to make room for traces
    std::int64_t points_added = 0;  ///< number of interior corners that are not centres
    // The following members are set only for Voronoi cells, if traces are too close together for rows of cells.
    std::int64_t cells_cut = 0;  ///< number of cells cut by traces
    /// Number of pieces smaller than smallest_piece_share of the mean cell that were merged with a neighbour.
    std::int64_t pieces_joined = 0;
};

/// Cells that fill the domain or its outline, apart from the gaps between them.
struct Mesh {
    std::vector<Point> corners;  ///< corners of all cells, in spatial order
    std::vector<Cell> cells;     ///< Voronoi cells in the order of their centres, or triangles in spatial order
    /// For each corner, the trace on the edge to the cell's next corner, as an index into MeshRequest::traces, or -1.
    /// Empty in a mesh without traces.
    std::vector<int> edge_traces;
    MeshReport report;

    /// Corners of a cell, m, counter-clockwise.
    std::span<const Point> outline(const Cell& cell) const {
        return std::span(corners).subspan(cell.first_corner, cell.corner_count);
    }
};

/// Worst shapes and sizes among the cells of a mesh.
struct MeshQuality {
    double smallest_angle = 0.0;  ///< degrees
    double smallest_area = 0.0;   ///< area of the smallest cell before the inset, relative to the mean area
    double shortest_edge = 0.0;   ///< length of the shortest edge after the inset, relative to the mean length
};
/// Smallest angle, area and edge of a mesh that has cells.
MeshQuality quality_of(const Mesh& mesh);

/// Thrown if no mesh can be made from the centres, the traces or the request. `centres` and `traces` contain the
/// indices of the centres and traces that caused the error, if any.
class MeshError : public std::runtime_error {
  public:
    /// Error with a message and the indices of the centres and traces that it names.
    explicit MeshError(const std::string& text, std::vector<int> named_centres = {}, std::vector<int> named_traces = {})
        : std::runtime_error(text), centres(std::move(named_centres)), traces(std::move(named_traces)) {}

    std::vector<int> centres, traces;
};

/// Thrown if the caller has cancelled meshing.
class MeshInterrupted : public std::exception {
  public:
    /// Returns a fixed text.
    const char* what() const noexcept override { return "interrupted while meshing"; }
};

/// Partitions `domain` and insets every cell. The same input gives identical results. The time needed is two to three
/// times that for inserting the centres with CGAL alone (tests/benchmarks/meshing.cpp). Each round of merging Voronoi
/// cells takes as long again.
/// @param centres  inside the domain or on its boundary
/// @throws MeshError if there are no centres, if centres coincide, lie outside or are NaN, or if the domain has no
/// area. It is also thrown if `mesh_gap` or `inset` is invalid, if there is no triangle, or if a cell is destroyed.
/// @throws MeshInterrupted if `interrupted` returned true
Mesh make_mesh(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request);

}  // namespace crackle
