// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulation and its dual Voronoi partition of a rectangle, by CGAL (exact predicates, inexact
// constructions).
//
// A centre whose cell would cross a wall is mirrored across it. The wall then becomes an edge of the partition, since
// beyond it every mirror image is nearer than its centre. Images are added until every centre next to an image across a
// wall has its own image there, and no circumcentre of centres lies outside. The result equals the partition with all
// centres mirrored. What lies on a wall is then determined by the triangulation instead of coordinates. A face between
// centres and images across a wall has its circumcentre exactly on that wall (in the corner for two walls). Positions
// are therefore set exactly there, so that cell areas sum to that of the domain despite round-off. Four distant guard
// points close the cells of the outermost centres from the start; they are farther from every point of the domain than
// any centre. A centre exactly on a wall is its own image; its cell is clipped at the wall.

#include "mesher/partition.hpp"

#include <CGAL/Spatial_sort_traits_adapter_2.h>
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
#include "mesher/partition_net.hpp"

namespace crackle {
namespace partition {
namespace {

constexpr std::array<std::uint8_t, 4> all_sides{side_left, side_right, side_bottom, side_top};
// Edges shorter than this fraction of their circumradius count as zero-length edges of co-circular centres. The
// round-off of a circumcentre is a few times relative_rounding times the radius; 1e-10 leaves a margin for badly shaped
// triangles.
constexpr double zero_edge_share = 1e-10;
// Distance between two centres, relative to the mean spacing, below which their bisector and cells are dominated by
// round-off.
constexpr double coincidence_share = 1e-9;
// Distance of the guard points from the middle of the domain, in units of the domain's diagonal. Every point of the
// domain is then closer to its nearest centre than to a guard point.
constexpr double guard_distance = 4.0;

// The circumcentre is computed relative to one corner, so that large coordinates cause round-off only in the last
// addition.
Point circumcentre(FaceHandle face) {
    const Point a = position(face->vertex(0)), b = position(face->vertex(1)), c = position(face->vertex(2));
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double twice = 2.0 * (bx * cy - by * cx);
    return {a.x + (cy * b2 - by * c2) / twice, a.y + (bx * c2 - cx * b2) / twice};
}

}  // namespace

void Partition::insert_guards() {
    const double reach = guard_distance * distance({domain_.x1, domain_.y1}, {domain_.x2, domain_.y2});
    const double x = 0.5 * (domain_.x1 + domain_.x2), y = 0.5 * (domain_.y1 + domain_.y2);
    for (const auto& [dx, dy] : {std::pair{-reach, 0.0}, {reach, 0.0}, {0.0, -reach}, {0.0, reach}}) {
        guards_.push_back(triangulation_.insert(CgalPoint(x + dx, y + dy)));
    }
}

// Inserts centres along a space-filling curve, so that each is located quickly from the previous one. The index of the
// centre is stored in the vertex.
void Partition::insert_centres() {
    using Placed = std::pair<CgalPoint, int>;  // sorted directly, since sorting indices would access memory at random
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

// Point where the bisector of the face's corners meets the wall. It has the same distance from all of the face's
// centres, where an image is replaced by its centre. The pair of corners farthest apart along the wall is used, which
// avoids differences of nearly equal squares.
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
    // This order ensures that the two faces formed by a pair of centres and their images get identical values.
    if (along[i] > along[j]) std::swap(i, j);
    const double apart = along[j] - along[i];
    const double place = along[i] + 0.5 * apart + 0.5 * ((off[j] - off[i]) / apart) * (off[j] + off[i]);
    return upright ? Point{level, place} : Point{place, level};
}

// Circumcentre of the face. It is placed exactly on each wall across which the face has an image, unless all centres of
// the face lie on that wall.
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
        default:  // no wall, or two opposite walls with some images still missing
            return circumcentre(face);
    }
}

// Stores the dual of the face, and records the walls across which its centres still have to be mirrored.
void Partition::place_dual(FaceHandle face, std::vector<VertexHandle>& to_mirror) {
    const WallsOfFace walls = walls_of(face);
    if (!walls.any_centre) return;
    const Point p = dual(face, walls);
    const unsigned beyond = walls_beyond(p);
    FaceInfo& placed = face->info();
    placed.dual = p;
    placed.outside = (beyond & walls.on_all) != 0;
    // If the face still exists after its centres have been mirrored, its dual is outside only by round-off.
    if (beyond != 0 && !placed.outside) {
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
    // A cell that crosses a wall has a corner beyond it, so apart from round-off one round is sufficient. Only faces
    // around new images and their centres can have changed.
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

// Collects the cells. @return false if a cell has a zero-length edge and such edges are not allowed
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

// Clips the cell of a centre on a wall, which extends beyond that wall.
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

// Merges circumcentres that differ only by round-off, consistently for all cells, so that the areas still add up.
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
    // Upper bound on `zero` below: no dual is farther from a centre of its face than the domain's diagonal.
    const double longest_zero = 4.0 * zero_edge({domain_.x1, domain_.y1}, {domain_.x2, domain_.y2});
    for (const FaceHandle f : triangulation_.finite_face_handles()) {
        for (int k = 0; k < 3; ++k) {
            const FaceHandle g = f->neighbor(k);
            const Point p = f->info().dual, q = g->info().dual;
            const double length = squared_distance(p, q);
            if (length >= longest_zero) continue;  // this test comes first, because it excludes most edges
            if (g < f) continue;                   // the edge is processed with its other face
            const VertexHandle a = f->vertex(Triangulation::ccw(k)), b = f->vertex(Triangulation::cw(k));
            if (!is_centre(a) && !is_centre(b)) continue;
            if (f->info().outside || g->info().outside) continue;
            const double zero = 4.0 * zero_edge(p, position(is_centre(a) ? a : b));
            if (length < zero) parent[root(member(f))] = root(member(g));
        }
    }
    // All members of a cluster are moved to the member that lies on the largest number of walls. Ties are broken by
    // coordinates, so the result does not depend on how the faces are numbered.
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

// Whether the cell of the image's centre has an edge on the wall, and not merely a co-circular contact.
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
        if (v->info().origin != Origin::guard) return;  // a centre or another projection is already there
        v->info() = {-1, Origin::added};
    };
    for (const Point corner : corners()) add(corner, guards_.front()->face());
    for (const VertexHandle guard : guards_) triangulation_.remove(guard);
    for (const Foot& foot : on_walls) add(foot.place, foot.beside->face());
}

Triangles Partition::points_with_flat_faces() const {
    Triangles out;
    const auto add = [&out](Point p, int centre) {
        out.points.push_back(p);
        out.centre_of.push_back(centre);
    };
    std::set<std::pair<double, double>> taken;  // positions of corners, of projections, and of centres on a wall
    for (const VertexHandle v : triangulation_.finite_vertex_handles()) {
        if (!is_centre(v)) continue;
        add(position(v), v->info().index);
        if (v->info().walls != 0) taken.insert({v->point().x(), v->point().y()});
    }
    const auto add_on_wall = [&](Point p) {
        if (taken.insert({p.x, p.y}).second) add(p, -1);
    };
    for (const Point corner : corners()) add_on_wall(corner);
    for (const Foot& foot : feet()) add_on_wall(foot.place);
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

}  // namespace partition

MeshError coincident_centres(std::span<const CellCentre> centres, int a, int b) {
    const auto [first, second] = std::minmax(a, b);
    const CellCentre& p = centres[static_cast<std::size_t>(first)];
    const CellCentre& q = centres[static_cast<std::size_t>(second)];
    return MeshError(fmt::format("mesh: found centres {} and {} at the same place, ({}, {}) and ({}, {}), only {:.3g} "
                                 "apart, expected distinct centres; remove one of them",
                                 first, second, p.x, p.y, q.x, q.y, distance(p, q)),
                     {first, second});
}

double coordinate_scale(const Rectangle& domain) {
    return std::max({std::abs(domain.x1), std::abs(domain.x2), std::abs(domain.y1), std::abs(domain.y2)});
}

VoronoiCells voronoi_cells(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience) {
    return partition::Partition(centres, domain, patience).cells();
}

Triangles delaunay_triangles(std::span<const CellCentre> centres, const Rectangle& domain, Boundary boundary,
                             Patience& patience) {
    return partition::Partition(centres, domain, patience).triangles(boundary);
}

Triangles delaunay_points(std::span<const CellCentre> centres, const Rectangle& domain, Patience& patience) {
    return partition::Partition(centres, domain, patience).points_with_flat_faces();
}

}  // namespace crackle
