// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation and its dual Voronoi partition of a rectangle, by CGAL (exact predicates, inexact
// constructions).
//
// A centre whose cell would cross a wall is mirrored across it, which makes the wall an edge of the partition: beyond a
// wall every mirror image is nearer than its centre. Images are added until every centre that meets an image across a
// wall has its own there and no circumcentre of centres lies outside, which is the partition that mirroring all centres
// would give. What is on a wall is then known from the triangulation, not from coordinates: a face of centres and
// images across a wall has its circumcentre exactly on that wall (two walls: in the corner). So positions are put
// there, and cell areas sum to the domain's whatever the rounding. Four guards far away close the cells of outermost
// centres from the start; they are further from every point of the domain than any centre is. A centre exactly on a
// wall is its own image; its cell is cut at the wall.

#include "mesher/partition.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "mesher/inset.hpp"

namespace crackle {
namespace {

enum class Origin : std::uint8_t { centre, image, guard, added };

// All that is known of a centre is kept here, not in arrays by centre: neighbours in space are neighbours in memory.
struct VertexInfo {
    int index = -1;  // centre (also an image's); once triangles are numbered, the point
    Origin origin = Origin::guard;
    // Sets of SideBit.
    std::uint8_t walls = 0;    // a centre: those it lies on; an image: the one it was mirrored across
    std::uint8_t settled = 0;  // a centre: those it is mirrored across or lies on
    std::uint8_t pending = 0;  // a centre: those to be mirrored across in the present round
};

struct FaceInfo {
    Point dual;            // circumcentre, where the Voronoi cells of the corners meet
    int index = -1;        // triangle, or member of a cluster of equal duals
    bool outside = false;  // beyond a wall on which all of the face's centres lie
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using CgalPoint = Triangulation::Point;
using VertexHandle = Triangulation::Vertex_handle;
using FaceHandle = Triangulation::Face_handle;

constexpr std::array<std::uint8_t, 4> all_sides{side_left, side_right, side_bottom, side_top};
// Edges shorter than this share of their circumradius are taken for the zero-length edges of co-circular centres: the
// rounding of a circumcentre is some relative_rounding of the radius, and 1e-10 leaves room for badly shaped triangles.
constexpr double zero_edge_share = 1e-10;
// Centres nearer than this share of the mean spacing have a bisector, and cells, made of rounding errors.
constexpr double coincidence_share = 1e-9;
// Distance of the guards from the middle, in diagonals of the domain: none of its points is as far from its nearest
// centre.
constexpr double guard_distance = 4.0;

double squared_distance(Point a, Point b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }

Point position(VertexHandle v) { return {v->point().x(), v->point().y()}; }

// Relative to one corner, so that the size of the coordinates does not enter before the last addition.
Point circumcentre(FaceHandle face) {
    const Point a = position(face->vertex(0)), b = position(face->vertex(1)), c = position(face->vertex(2));
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double twice = 2.0 * (bx * cy - by * cx);
    return {a.x + (cy * b2 - by * c2) / twice, a.y + (bx * c2 - cx * b2) / twice};
}

// What the corners of a face have to do with walls: sets of SideBit.
struct WallsOfFace {
    unsigned images = 0;    // those across which a corner is an image
    unsigned on_all = ~0U;  // those on which all corners lie that are centres
    bool any_centre = false;
};

WallsOfFace walls_of(FaceHandle face) {
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
    /// Those of the triangles that fill the domain, which are not made.
    Triangles points_with_flat_faces() const;

  private:
    struct Image {
        VertexHandle vertex, centre;
        std::uint8_t wall;
    };
    /// Of a cell that has an edge on a wall.
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

void Partition::insert_guards() {
    const double reach = guard_distance * distance({domain_.x1, domain_.y1}, {domain_.x2, domain_.y2});
    const double x = 0.5 * (domain_.x1 + domain_.x2), y = 0.5 * (domain_.y1 + domain_.y2);
    for (const auto& [dx, dy] : {std::pair{-reach, 0.0}, {reach, 0.0}, {0.0, -reach}, {0.0, reach}}) {
        guards_.push_back(triangulation_.insert(CgalPoint(x + dx, y + dy)));
    }
}

// Along a space-filling curve, each located from the one before; the centre's number travels in the vertex.
void Partition::insert_centres() {
    using Placed = std::pair<CgalPoint, int>;  // sorted itself: sorting numbers of places would wait for memory
    std::vector<Placed> order;
    order.reserve(centres_.size());
    for (const CellCentre& centre : centres_)
        order.emplace_back(CgalPoint(centre.x, centre.y), static_cast<int>(order.size()));
    using PlaceOf = CGAL::First_of_pair_property_map<Placed>;
    CGAL::spatial_sort(order.begin(), order.end(), CGAL::Spatial_sort_traits_adapter_2<Kernel, PlaceOf>());
    FaceHandle hint = guards_.back()->face();
    for (const auto& [place, number] : order) {
        patience_.piece();
        const std::size_t before = triangulation_.number_of_vertices();
        const VertexHandle v = triangulation_.insert(place, hint);
        if (triangulation_.number_of_vertices() == before) throw coincident_centres(centres_, v->info().index, number);
        const auto lies_on = static_cast<std::uint8_t>(sides_at({place.x(), place.y()}, domain_));
        v->info() = {number, Origin::centre, lies_on, lies_on, 0};
        hint = v->face();
    }
}

unsigned Partition::walls_beyond(Point p) const {
    return side_if(p.x < domain_.x1, side_left) | side_if(p.x > domain_.x2, side_right) |
           side_if(p.y < domain_.y1, side_bottom) | side_if(p.y > domain_.y2, side_top);
}

// Where the bisector of the face's corners meets the wall: (p - wall)² + (y - s)² equal for two of them, an image
// standing for its centre. The pair that is furthest apart along the wall is taken; no difference of nearly equal
// squares enters.
Point Partition::on_wall(FaceHandle face, std::uint8_t wall) const {
    const bool upright = wall == side_left || wall == side_right;
    const double level = wall == side_left     ? domain_.x1
                         : wall == side_right  ? domain_.x2
                         : wall == side_bottom ? domain_.y1
                                               : domain_.y2;
    std::array<double, 3> along{}, off{};
    for (int k = 0; k < 3; ++k) {
        const VertexInfo& info = face->vertex(k)->info();
        const bool mirrored = info.origin == Origin::image && info.walls == wall;
        const Point p = mirrored ? centres_[static_cast<std::size_t>(info.index)] : position(face->vertex(k));
        along[static_cast<std::size_t>(k)] = upright ? p.y : p.x;
        off[static_cast<std::size_t>(k)] = (upright ? p.x : p.y) - level;
    }
    std::size_t i = 0, j = 1;
    if (std::abs(along[1] - along[2]) > std::abs(along[i] - along[j])) i = 1, j = 2;
    if (std::abs(along[0] - along[2]) > std::abs(along[i] - along[j])) i = 0, j = 2;
    if (along[i] > along[j]) std::swap(i, j);  // the faces on both sides of a pair and its images get the same bits
    const double apart = along[j] - along[i];
    const double place = along[i] + 0.5 * apart + 0.5 * ((off[j] - off[i]) / apart) * (off[j] + off[i]);
    return upright ? Point{level, place} : Point{place, level};
}

// The face's circumcentre. It is known to lie on the walls across which the face has an image, but for those on which
// all of its centres lie.
Point Partition::dual(FaceHandle face, const WallsOfFace& walls) const {
    const unsigned snapped = walls.images & ~walls.on_all;
    switch (snapped) {
        case side_left:
        case side_right:
        case side_bottom:
        case side_top:
            return on_wall(face, static_cast<std::uint8_t>(snapped));
        case side_left | side_bottom:
            return {domain_.x1, domain_.y1};
        case side_right | side_bottom:
            return {domain_.x2, domain_.y1};
        case side_left | side_top:
            return {domain_.x1, domain_.y2};
        case side_right | side_top:
            return {domain_.x2, domain_.y2};
        default:  // no wall, or opposite walls while images are still missing
            return circumcentre(face);
    }
}

// Puts the face's dual in its place, and notes the walls across which its centres must still be mirrored.
void Partition::place_dual(FaceHandle face, std::vector<VertexHandle>& to_mirror) {
    const WallsOfFace walls = walls_of(face);
    if (!walls.any_centre) return;
    const Point p = dual(face, walls);
    const unsigned beyond = walls_beyond(p);
    FaceInfo& placed = face->info();
    placed.dual = p;
    placed.outside = (beyond & walls.on_all) != 0;
    if (beyond != 0 && !placed.outside) {  // by rounding, if the face is still there once its centres are mirrored
        placed.dual = {std::clamp(p.x, domain_.x1, domain_.x2), std::clamp(p.y, domain_.y1, domain_.y2)};
    }
    const unsigned needs = walls.images | beyond;
    if (needs == 0) return;
    for (int k = 0; k < 3; ++k) {
        const VertexHandle v = face->vertex(k);
        if (!is_centre(v)) continue;
        const unsigned missing = needs & ~unsigned{v->info().settled};
        if (missing == 0) continue;
        if (v->info().pending == 0) to_mirror.push_back(v);
        v->info().pending = static_cast<std::uint8_t>(v->info().pending | missing);
    }
}

void Partition::mirror(VertexHandle centre, std::uint8_t walls, std::vector<VertexHandle>& touched) {
    const Point s = position(centre);
    for (const std::uint8_t wall : all_sides) {
        if ((walls & wall) == 0) continue;
        const Point place = wall == side_left     ? Point{2.0 * domain_.x1 - s.x, s.y}
                            : wall == side_right  ? Point{2.0 * domain_.x2 - s.x, s.y}
                            : wall == side_bottom ? Point{s.x, 2.0 * domain_.y1 - s.y}
                                                  : Point{s.x, 2.0 * domain_.y2 - s.y};
        const VertexHandle v = triangulation_.insert(CgalPoint(place.x, place.y), centre->face());
        v->info() = {centre->info().index, Origin::image, wall};
        images_.push_back({v, centre, wall});
        auto neighbour = triangulation_.incident_vertices(v);
        const auto end = neighbour;
        do {
            if (!triangulation_.is_infinite(neighbour) && is_centre(neighbour)) touched.push_back(neighbour);
        } while (++neighbour != end);
    }
    centre->info().settled = static_cast<std::uint8_t>(centre->info().settled | walls);
    touched.push_back(centre);
}

void Partition::refuse_near_coincident(FaceHandle face, double too_close) const {
    for (int k = 0; k < 3; ++k) {
        const VertexHandle a = face->vertex(k), b = face->vertex(Triangulation::ccw(k));
        if (is_centre(a) && is_centre(b) && squared_distance(position(a), position(b)) < too_close * too_close) {
            throw coincident_centres(centres_, a->info().index, b->info().index);
        }
    }
}

void Partition::mirror_where_needed() {
    const double spacing =
        std::sqrt((domain_.x2 - domain_.x1) * (domain_.y2 - domain_.y1) / static_cast<double>(centres_.size()));
    const double too_close = std::max(64.0 * relative_rounding * scale_, coincidence_share * spacing);
    std::vector<VertexHandle> to_mirror, touched;
    for (const FaceHandle face : triangulation_.finite_face_handles()) {
        patience_.piece();
        refuse_near_coincident(face, too_close);
        place_dual(face, to_mirror);
    }
    // A cell that crosses a wall has a corner beyond it, so one round is all but for rounding. Only faces around new
    // images and their centres can have changed.
    const auto number = [](VertexHandle v) { return v->info().index; };
    while (!to_mirror.empty()) {
        touched.clear();
        for (const VertexHandle centre : to_mirror)
            mirror(centre, std::exchange(centre->info().pending, std::uint8_t{0}), touched);
        to_mirror.clear();
        std::ranges::sort(touched, {}, number);
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const VertexHandle centre : touched) {
            auto face = triangulation_.incident_faces(centre);
            const auto end = face;
            do place_dual(face, to_mirror);
            while (++face != end);
        }
    }
}

double Partition::zero_edge(Point dual_point, Point centre) const {
    const double rounding = 64.0 * relative_rounding * scale_;
    return std::max(rounding * rounding, zero_edge_share * zero_edge_share * squared_distance(dual_point, centre));
}

// @return false if a cell has a zero-length edge, unless they are allowed.
bool Partition::collect_cells(VoronoiCells& out, bool allow_zero_edges) const {
    out.corners.clear();
    out.corners.reserve(6 * centres_.size() + 16);
    out.cells.clear();
    out.cells.reserve(centres_.size());
    std::vector<Point> polygon, scratch;
    for (const VertexHandle v : triangulation_.finite_vertex_handles()) {
        if (!is_centre(v)) continue;
        patience_.piece();
        polygon.clear();
        bool outside = false;
        auto face = triangulation_.incident_faces(v);
        const auto end = face;
        do {
            outside = outside || face->info().outside;
            const Point p = face->info().dual;
            if (polygon.empty() || p != polygon.back()) polygon.push_back(p);
        } while (++face != end);
        while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
        if (outside) cut_at_walls(polygon, scratch);
        for (std::size_t k = 0; !allow_zero_edges && !outside && k < polygon.size(); ++k) {
            const Point p = polygon[k], q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
            if (squared_distance(p, q) < zero_edge(p, position(v))) return false;
        }
        out.cells.push_back({static_cast<std::uint32_t>(out.corners.size()), static_cast<std::uint32_t>(polygon.size()),
                             v->info().index});
        out.corners.insert(out.corners.end(), polygon.begin(), polygon.end());
    }
    return true;
}

// The cell of a centre on a wall reaches beyond it.
void Partition::cut_at_walls(std::vector<Point>& polygon, std::vector<Point>& scratch) const {
    clip(polygon, 1.0, 0.0, domain_.x1, scratch);
    clip(polygon, -1.0, 0.0, -domain_.x2, scratch);
    clip(polygon, 0.0, 1.0, domain_.y1, scratch);
    clip(polygon, 0.0, -1.0, -domain_.y2, scratch);
    const double rounding = 64.0 * relative_rounding * scale_;
    for (Point& p : polygon) {
        for (const double x : {domain_.x1, domain_.x2}) p.x = std::abs(p.x - x) <= rounding ? x : p.x;
        for (const double y : {domain_.y1, domain_.y2}) p.y = std::abs(p.y - y) <= rounding ? y : p.y;
    }
    const auto near = [rounding](Point a, Point b) { return squared_distance(a, b) <= rounding * rounding; };
    polygon.erase(std::unique(polygon.begin(), polygon.end(), near), polygon.end());
    while (polygon.size() > 1 && near(polygon.front(), polygon.back())) polygon.pop_back();
}

// Joins circumcentres that differ by rounding alone, for all cells alike, so that the areas still add up.
void Partition::contract_zero_edges() {
    std::vector<FaceHandle> members;
    std::vector<std::size_t> parent;
    const auto root = [&parent](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    const auto member = [&](FaceHandle face) {
        if (face->info().index < 0) {
            face->info().index = static_cast<int>(members.size());
            parent.push_back(members.size());
            members.push_back(face);
        }
        return static_cast<std::size_t>(face->info().index);
    };
    // No dual is further from a centre of its face than that.
    const double longest_zero = 4.0 * zero_edge({domain_.x1, domain_.y1}, {domain_.x2, domain_.y2});
    for (const FaceHandle f : triangulation_.finite_face_handles()) {
        for (int k = 0; k < 3; ++k) {
            const FaceHandle g = f->neighbor(k);
            const Point p = f->info().dual, q = g->info().dual;
            const double length = squared_distance(p, q);
            if (length >= longest_zero) continue;  // first, for nearly all are
            if (g < f) continue;                   // the edge is met from there
            const VertexHandle a = f->vertex(Triangulation::ccw(k)), b = f->vertex(Triangulation::cw(k));
            if (!is_centre(a) && !is_centre(b)) continue;
            if (f->info().outside || g->info().outside) continue;
            const double zero = 4.0 * zero_edge(p, position(is_centre(a) ? a : b));
            if (length < zero) parent[root(member(f))] = root(member(g));
        }
    }
    // A point on walls stands for those beside it; the order decides among equals, whatever the numbering of faces.
    const auto walls = [this](Point p) {
        return (p.x == domain_.x1 || p.x == domain_.x2 ? 1 : 0) + (p.y == domain_.y1 || p.y == domain_.y2 ? 1 : 0);
    };
    const auto stands_before = [&walls](Point p, Point q) {
        if (walls(p) != walls(q)) return walls(p) > walls(q);
        return p.x != q.x ? p.x < q.x : p.y < q.y;
    };
    std::vector<Point> best(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) best[k] = members[k]->info().dual;
    for (std::size_t k = 0; k < members.size(); ++k) {
        Point& chosen = best[root(k)];
        if (stands_before(members[k]->info().dual, chosen)) chosen = members[k]->info().dual;
    }
    for (std::size_t k = 0; k < members.size(); ++k) {
        members[k]->info().dual = best[root(k)];
        members[k]->info().index = -1;
    }
}

VoronoiCells Partition::cells() {
    VoronoiCells out;
    if (!collect_cells(out, false)) {
        contract_zero_edges();
        collect_cells(out, true);
    }
    return out;
}

// The cell of the image's centre has an edge on the wall, not just a co-circular touch.
bool Partition::meets_wall(const Image& image) const {
    FaceHandle face;
    int k = 0;
    if (!triangulation_.is_edge(image.centre, image.vertex, face, k)) return false;
    const FaceHandle other = face->neighbor(k);
    const Point p = dual(face, walls_of(face)), q = dual(other, walls_of(other));
    return squared_distance(p, q) > zero_edge(p, position(image.centre));
}

std::vector<Partition::Foot> Partition::feet() const {
    std::vector<Foot> feet;
    for (const Image& image : images_) {
        if (!meets_wall(image)) continue;
        Point foot = position(image.centre);
        if (image.wall == side_left) foot.x = domain_.x1;
        if (image.wall == side_right) foot.x = domain_.x2;
        if (image.wall == side_bottom) foot.y = domain_.y1;
        if (image.wall == side_top) foot.y = domain_.y2;
        feet.push_back({foot, image.centre});
    }
    return feet;
}

std::array<Point, 4> Partition::corners() const {
    return {{{domain_.x1, domain_.y1}, {domain_.x1, domain_.y2}, {domain_.x2, domain_.y1}, {domain_.x2, domain_.y2}}};
}

void Partition::close_with_flat_faces() {
    const std::vector<Foot> on_walls = feet();
    for (const Image& image : images_) triangulation_.remove(image.vertex);
    images_.clear();
    const auto add = [&](Point p, FaceHandle hint) {
        const VertexHandle v = triangulation_.insert(CgalPoint(p.x, p.y), hint);
        if (v->info().origin != Origin::guard) return;  // a centre, or another foot, is there already
        v->info() = {-1, Origin::added};
    };
    for (const Point corner : corners()) add(corner, guards_.front()->face());
    for (const VertexHandle guard : guards_) triangulation_.remove(guard);
    for (const Foot& foot : on_walls) add(foot.place, foot.beside->face());
}

// In the order in which the triangulation would have them: a new vertex goes where one was removed last, and behind all
// others where none is left.
Triangles Partition::points_with_flat_faces() const {
    Triangles out;
    const auto add = [&out](Point p, int centre) {
        out.points.push_back(p);
        out.centre_of.push_back(centre);
    };
    std::vector<VertexHandle> centres;
    std::set<std::pair<double, double>> taken;
    for (const VertexHandle v : triangulation_.finite_vertex_handles()) {
        if (!is_centre(v)) continue;
        centres.push_back(v);
        if (v->info().walls != 0) taken.insert({v->point().x(), v->point().y()});
    }
    std::vector<std::optional<Point>> added(guards_.size() + images_.size());  // images come behind the centres
    std::vector<std::size_t> removed;
    const auto put = [&](Point p) {
        if (!taken.insert({p.x, p.y}).second) return;
        if (removed.empty()) {
            added.emplace_back(p);
            return;
        }
        added[removed.back()] = p;
        removed.pop_back();
    };
    for (std::size_t k = guards_.size(); k < added.size(); ++k) removed.push_back(k);
    for (const Point corner : corners()) put(corner);
    for (std::size_t k = 0; k < guards_.size(); ++k) removed.push_back(k);
    for (const Foot& foot : feet()) put(foot.place);
    out.points.reserve(centres.size() + added.size());
    out.centre_of.reserve(centres.size() + added.size());
    const auto add_from = [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            if (added[k]) add(*added[k], -1);
    };
    add_from(0, guards_.size());
    for (const VertexHandle v : centres) add(position(v), v->info().index);
    add_from(guards_.size(), added.size());
    return out;
}

Triangles Partition::points(Boundary boundary) {
    Triangles out;
    if (boundary == Boundary::domain) close_with_flat_faces();
    out.points.reserve(triangulation_.number_of_vertices());
    out.centre_of.reserve(triangulation_.number_of_vertices());
    for (const VertexHandle v : triangulation_.finite_vertex_handles()) {
        if (!is_kept(v)) continue;
        out.centre_of.push_back(v->info().index);
        v->info().index = static_cast<int>(out.points.size());
        out.points.push_back(position(v));
    }
    return out;
}

Triangles Partition::triangles(Boundary boundary) {
    Triangles out = points(boundary);
    std::vector<FaceHandle> faces;
    faces.reserve(2 * out.points.size());
    for (const FaceHandle face : triangulation_.finite_face_handles()) {
        if (!is_kept(face->vertex(0)) || !is_kept(face->vertex(1)) || !is_kept(face->vertex(2))) continue;
        face->info().index = static_cast<int>(faces.size());
        faces.push_back(face);
    }
    out.corners.reserve(faces.size());
    out.neighbours.reserve(faces.size());
    for (const FaceHandle face : faces) {
        out.corners.push_back(
            {face->vertex(0)->info().index, face->vertex(1)->info().index, face->vertex(2)->info().index});
        out.neighbours.push_back(
            {face->neighbor(0)->info().index, face->neighbor(1)->info().index, face->neighbor(2)->info().index});
    }
    return out;
}

}  // namespace

MeshError coincident_centres(std::span<const CellCentre> centres, int a, int b) {
    const auto [first, second] = std::minmax(a, b);
    const CellCentre& p = centres[static_cast<std::size_t>(first)];
    const CellCentre& q = centres[static_cast<std::size_t>(second)];
    return MeshError(
        fmt::format("mesh: found centres {} and {} at the same place (({}, {}) and ({}, {}), {:.3g} apart), expected "
                    "distinct centres; remove one of them",
                    first, second, p.x, p.y, q.x, q.y, std::sqrt(squared_distance(p, q))),
        {first, second});
}

double coordinate_scale(const Rectangle& domain) {
    return std::max({std::abs(domain.x1), std::abs(domain.x2), std::abs(domain.y1), std::abs(domain.y2)});
}

VoronoiCells voronoi_cells(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience) {
    return Partition(centres, domain, patience).cells();
}

Triangles delaunay_triangles(std::span<const CellCentre> centres, const Rectangle& domain, Boundary boundary,
                             Patience& patience) {
    return Partition(centres, domain, patience).triangles(boundary);
}

Triangles delaunay_points(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience) {
    return Partition(centres, domain, patience).points_with_flat_faces();
}

}  // namespace crackle
