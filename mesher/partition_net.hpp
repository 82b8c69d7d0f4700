// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL triangulation from which partition.cpp computes partitions; described in partition.cpp and used only there.
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

class Patience;
struct Triangles;
struct VoronoiCells;

namespace partition {

enum class Origin : std::uint8_t { centre, image, guard, added };

// All data of a centre are stored in the vertex rather than in per-centre arrays, so that neighbours in space are also
// neighbours in memory.
struct VertexInfo {
    int index = -1;  // index of the centre (for an image, of its original); after numbering, index of the point
    Origin origin = Origin::guard;
    // Set of SideBits. For a centre: walls on which it lies; for an image: the wall across which it was mirrored.
    std::uint8_t walls = 0;
    std::uint8_t settled = 0;  // for a centre: walls on which it lies or across which it has been mirrored
    std::uint8_t pending = 0;  // for a centre: walls across which it is to be mirrored in this round
};

struct FaceInfo {
    Point dual;            // circumcentre, where the Voronoi cells of the three corners meet
    int index = -1;        // index of the triangle, or of a member of a cluster of coincident duals
    bool outside = false;  // whether the dual is beyond a wall on which all centres of the face lie
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using CgalPoint = Triangulation::Point;
using VertexHandle = Triangulation::Vertex_handle;
using FaceHandle = Triangulation::Face_handle;

inline double squared_distance(Point a, Point b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }

inline Point position(VertexHandle v) { return {v->point().x(), v->point().y()}; }

// Relation of a face's corners to the walls, as sets of SideBits.
struct WallsOfFace {
    unsigned images = 0;    // walls across which at least one corner is an image
    unsigned on_all = ~0U;  // walls on which all corners that are centres lie
    bool any_centre = false;
};

inline WallsOfFace walls_of(FaceHandle face) {
    WallsOfFace walls;
    for (int k = 0; k < 3; ++k) {
        const VertexInfo& info = face->vertex(k)->info();
        if (info.origin == Origin::image) walls.images |= info.walls;
        if (info.origin == Origin::centre) walls.on_all &= info.walls;
        walls.any_centre = walls.any_centre || info.origin == Origin::centre;
    }
    return walls;
}

class Partition {
  public:
    Partition(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience)
        : centres_(centres), domain_(domain), patience_(patience), scale_(coordinate_scale(domain)) {
        insert_guards();
        insert_centres();
        mirror_where_needed();
    }

    VoronoiCells cells();
    Triangles triangles(Boundary boundary);
    /// The points of the triangles that fill the domain, but no triangles.
    Triangles points_with_flat_faces() const;

  private:
    struct Image {
        VertexHandle vertex, centre;
        std::uint8_t wall;
    };
    /// Projection of a centre onto a wall on which its cell has an edge.
    struct Foot {
        Point place;
        VertexHandle beside;
    };

    void insert_guards();
    void insert_centres();
    void mirror_where_needed();
    void refuse_near_coincident(FaceHandle face, double too_close) const;
    void place_dual(FaceHandle face, std::vector<VertexHandle>& to_mirror);
    void mirror(VertexHandle centre, std::uint8_t walls, std::vector<VertexHandle>& touched);

    bool is_centre(VertexHandle v) const { return v->info().origin == Origin::centre; }
    static bool is_kept(VertexHandle v) {
        return v->info().origin == Origin::centre || v->info().origin == Origin::added;
    }
    unsigned walls_beyond(Point p) const;
    Point dual(FaceHandle face, const WallsOfFace& walls) const;
    Point on_wall(FaceHandle face, std::uint8_t wall) const;
    bool collect_cells(VoronoiCells& out, bool allow_zero_edges) const;
    void contract_zero_edges();
    void cut_at_walls(std::vector<Point>& polygon, std::vector<Point>& scratch) const;
    double zero_edge(Point dual_point, Point centre) const;
    bool meets_wall(const Image& image) const;
    std::vector<Foot> feet() const;
    std::array<Point, 4> corners() const;
    void close_with_flat_faces();
    Triangles points(Boundary boundary);

    std::span<const CellCentre> centres_;
    Rectangle domain_;
    Patience& patience_;
    double scale_;
    Triangulation triangulation_;
    std::vector<Image> images_;
    std::vector<VertexHandle> guards_;
};

}  // namespace partition

}  // namespace crackle
