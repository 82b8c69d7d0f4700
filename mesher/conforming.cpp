// SPDX-License-Identifier: GPL-3.0-or-later
// Traces are divided into pieces about as long as the spacing of the centres. Centres closer to a trace than 0.4
// spacings are omitted, since triangles between them and the trace would be too flat. Points on the walls are the same
// as in the mesh without traces. CGAL's mesher then splits pieces until each has an empty diametral circle, and inserts
// circumcentres where a triangle near a trace has a small angle. Away from traces, the triangles are those of the
// centres.

#include "mesher/conforming.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_criteria_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
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
#include <cstdint>
#include <limits>
#include <utility>

#include "mesher/place_grid.hpp"

namespace crackle {
namespace {

// Distance from a trace, relative to the spacing, within which centres are omitted. A triangle with a base of one
// spacing on the trace and its apex at a distance of 0.4 spacings has angles above 21 degrees.
constexpr double left_out_seed_share = 0.4;
constexpr double near_share =
    1.3;  // largest distance from a trace, relative to the spacing, of the triangles to be checked (the first row)
// Narrowest passage between traces, relative to the spacing, and sine of the smallest angle between them (1 degree).
// Smaller values are refused, since they would require triangles with equally small edges or angles.
constexpr double narrowest_share = 0.02, least_sine = 0.0175;
// Square of the sine of 20.7 degrees; refinement is guaranteed to terminate for angles up to this one.
constexpr double smallest_squared_sine = 0.125;

struct PointInfo {
    int centre = -1;
    bool near_trace = true;  // default value, which points added by refinement keep
    int number = -1;         // index of the point in the mesh
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using TracedVertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<PointInfo, Kernel, CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
struct FaceNumber {
    int value = -1;  // index of the triangle; -1 outside the mesh
};
using TracedFaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceNumber, Kernel, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using TracedStructure = CGAL::Triangulation_data_structure_2<TracedVertexBase, TracedFaceBase>;
using Unconstrained = CGAL::Delaunay_triangulation_2<Kernel, TracedStructure>;
using ConstrainedBase = CGAL::Constrained_Delaunay_triangulation_2<Kernel, TracedStructure, CGAL::Exact_predicates_tag>;
/// A triangulation that provides a list of its constrained edges, so that CGAL's mesher need not search for them around
/// every vertex.
class Constrained : public ConstrainedBase {
  public:
    // CGAL's mesher requires this tag for a triangulation that provides the list.
    using Constraint_hierarchy_tag = CGAL::Tag_true;
    using Listed = std::vector<std::pair<std::pair<Vertex_handle, Vertex_handle>, bool>>;
    using Subconstraint_iterator = Listed::const_iterator;
    Subconstraint_iterator subconstraints_begin() const { return listed_.begin(); }
    Subconstraint_iterator subconstraints_end() const { return listed_.end(); }
    void split_constraint(Vertex_handle, Vertex_handle, Vertex_handle) const {
    }  // not needed, since the list is read only once

    void list_constraints();

  private:
    Listed listed_;
};
using ConstrainedVertex = Constrained::Vertex_handle;
using ConstrainedFace = Constrained::Face_handle;

Point place_of(ConstrainedVertex v) { return {v->point().x(), v->point().y()}; }

/// Whether two edges from a common point meet at less than 60 degrees, or possibly do, given round-off.
bool meet_sharply(Point u, Point v) {
    const double along = dot(u, v);
    return !(along <= 0.0 || 4.0 * along * along < 0.999 * dot(u, u) * dot(v, v));
}

/// Lists the edges that CGAL's mesher may have to split, in the order in which it splits them. These are edges at a
/// sharp angle to another edge, and edges with a point inside their diametral circle.
void Constrained::list_constraints() {
    struct Arm {
        crackle::Point along;
        int next;  // index of the next edge (arm) at the same vertex, or -1
    };
    std::vector<Edge> edges;
    std::vector<Arm> arms;
    std::vector<int> last;    // for each vertex, index of its last edge (arm)
    std::vector<char> sharp;  // by vertex
    // Points do not have an index yet, so their field `number` can hold the index of the vertex.
    const auto number = [&](Vertex_handle v) -> int& { return v->info().number; };
    const auto add_arm = [&](Vertex_handle from, Vertex_handle to) {
        if (number(from) < 0) {
            number(from) = static_cast<int>(last.size());
            last.push_back(-1);
            sharp.push_back(0);
        }
        const auto at = static_cast<std::size_t>(number(from));
        const crackle::Point a = place_of(from), b = place_of(to), along{b.x - a.x, b.y - a.y};
        for (int other = last[at]; other >= 0; other = arms[static_cast<std::size_t>(other)].next)
            if (meet_sharply(along, arms[static_cast<std::size_t>(other)].along)) sharp[at] = 1;
        arms.push_back({along, std::exchange(last[at], static_cast<int>(arms.size()))});
    };
    for (const Face_handle face : all_face_handles()) {
        for (int k = 0; k < 3; ++k) {
            if (!face->is_constrained(k) || !(face < face->neighbor(k))) continue;
            edges.emplace_back(face, k);
            add_arm(face->vertex(cw(k)), face->vertex(ccw(k)));
            add_arm(face->vertex(ccw(k)), face->vertex(cw(k)));
        }
    }
    const auto near_circle = [&](Vertex_handle apex, crackle::Point a, crackle::Point b) {
        if (is_infinite(apex)) return false;
        const crackle::Point p = place_of(apex), u{a.x - p.x, a.y - p.y}, v{b.x - p.x, b.y - p.y};
        return dot(u, v) < 1e-3 * (dot(u, u) + dot(v, v));
    };
    listed_.clear();
    for (const auto& [face, k] : edges) {
        const Vertex_handle from = face->vertex(cw(k)), to = face->vertex(ccw(k));
        const crackle::Point a = place_of(from), b = place_of(to);
        if (sharp[static_cast<std::size_t>(number(from))] != 0 || sharp[static_cast<std::size_t>(number(to))] != 0 ||
            near_circle(face->vertex(k), a, b) || near_circle(tds().mirror_vertex(face, k), a, b))
            listed_.push_back({{from, to}, true});
    }
}

/// CGAL's quality criterion, applied only to triangles near a trace.
class NearTraceCriteria : public CGAL::Delaunay_mesh_criteria_2<Constrained> {
    using Base = CGAL::Delaunay_mesh_criteria_2<Constrained>;

  public:
    using Base::Base;
    class Is_bad : public Base::Is_bad {
      public:
        using Base::Is_bad::Is_bad;
        using Base::Is_bad::operator();
        CGAL::Mesh_2::Face_badness operator()(const Face_handle& face, Quality& quality) const {
            bool near = false;
            for (int k = 0; k < 3; ++k) near = near || face->vertex(k)->info().near_trace;
            if (near) return Base::Is_bad::operator()(face, quality);
            quality = 1.0;
            return CGAL::Mesh_2::NOT_BAD;
        }
    };
    Is_bad is_bad_object() const { return Is_bad(bound(), traits); }
};

struct TracePiece : Segment {
    int trace;
    int from, to;  // indices of the two ends among the points on traces
};

class Conforming {
  public:
    Conforming(const Rectangle& domain, const TraceGraph& graph, double spacing, Patience& patience)
        : domain_(domain), graph_(graph), patience_(patience), spacing_(spacing) {
        cut_into_pieces();
    }

    ConformingTriangles make(std::span<const CellCentre> centres) {
        const SegmentGrid grid({pieces_.begin(), pieces_.end()}, near_share * spacing_);
        refuse_narrow_passages(grid);
        insert_points(chosen_points(centres, grid));
        constrain();
        refine();
        number_points();
        collect();
        return std::move(out_);
    }

  private:
    struct ChosenPoint {
        Point place;
        PointInfo info;
    };

    void cut_into_pieces() {
        int points = static_cast<int>(graph_.nodes.size());  // points between nodes are numbered after the nodes
        for (const TraceGraph::Edge& edge : graph_.edges) {
            const Point a = graph_.nodes[static_cast<std::size_t>(edge.from)],
                        b = graph_.nodes[static_cast<std::size_t>(edge.to)];
            if (edge.trace < 0) continue;
            const auto parts = std::max(1, static_cast<int>(std::lround(distance(a, b) / spacing_)));
            Point last = a;
            int from = edge.from;
            for (int part = 1; part <= parts; ++part) {
                const double share = static_cast<double>(part) / parts;
                const Point next = part == parts ? b : Point{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
                const int to = part == parts ? edge.to : points++;
                pieces_.push_back({{last, next}, edge.trace, from, to});
                last = next;
                from = to;
            }
        }
        vertices_.resize(static_cast<std::size_t>(points));
    }

    [[noreturn]] void refuse_narrow(int trace, int other, Point at, const std::string& what) const {
        std::vector<int> named{trace};
        if (other >= 0 && other != trace) named.push_back(other);
        std::string beside = other < 0 ? "a wall" : fmt::format("trace {}", other);
        if (other == trace) beside = "another part of it";
        throw MeshError(
            fmt::format(
                "mesh: found trace {} and {} {} at ({:.9g}, {:.9g}), expected at least {:.4g} ({} of the mean spacing) "
                "between them, or 1 degree where they meet; remove or move a trace, or use smaller particles",
                trace, beside, what, at.x, at.y, narrowest_share * spacing_, narrowest_share),
            {}, std::move(named));
    }

    /// Refuses narrow passages between traces. Two straight pieces that do not cross are closest to each other at an
    /// end of one of them.
    void refuse_narrow_passages(const SegmentGrid& grid) const {
        const double narrow = narrowest_share * spacing_;
        for (const TracePiece& piece : pieces_) {
            for (const auto& ends : {std::pair{piece.a, piece.b}, {piece.b, piece.a}}) {
                // Named variables, because clang++ 14 cannot capture structured bindings.
                const auto &end = ends.first, &start = ends.second;
                // At a point between nodes, this end has already been checked with the previous piece.
                if (end == piece.a && piece.from >= static_cast<int>(graph_.nodes.size())) continue;
                grid.each_near(end, [&](std::size_t number) {
                    const TracePiece& other = pieces_[number];
                    if (surely_beyond(other, end, narrow)) return;
                    const bool meets = end == other.a || end == other.b;
                    if (!meets) {
                        const double away = distance_to(other, end);
                        if (away < narrow)
                            refuse_narrow(piece.trace, other.trace, end, fmt::format("{:.3g} apart", away));
                    } else if (&other != &piece) {
                        refuse_sharp(piece.trace, other.trace, end, start, end == other.a ? other.b : other.a);
                    }
                });
                refuse_near_walls(piece.trace, end, start, narrow);
            }
        }
    }
    /// Refuses two pieces that meet at too small an angle. @param at common starting point of the two pieces
    void refuse_sharp(int trace, int other, Point at, Point end, Point other_end) const {
        const Point u{end.x - at.x, end.y - at.y}, v{other_end.x - at.x, other_end.y - at.y};
        const double lengths = distance(at, end) * distance(at, other_end);
        if (u.x * v.x + u.y * v.y > 0.0 && std::abs(u.x * v.y - u.y * v.x) < least_sine * lengths)
            refuse_narrow(trace, other, at, "meeting at less than a degree");
    }
    void refuse_near_walls(int trace, Point end, Point start, double narrow) const {
        for (const auto& [level, upright] :
             {std::pair{domain_.x1, true}, {domain_.x2, true}, {domain_.y1, false}, {domain_.y2, false}}) {
            const double away = std::abs((upright ? end.x : end.y) - level);
            const double rise = std::abs((upright ? start.x : start.y) - level);
            if (away == 0.0 ? rise < least_sine * distance(start, end) : away < narrow)
                refuse_narrow(trace, -1, end,
                              away == 0.0 ? "meeting at less than a degree" : fmt::format("{:.3g} apart", away));
        }
    }

    /// Distance to the nearest trace, m. It is exact up to near_share; a larger value, possibly infinite, only means
    /// that the trace is farther away than that. Once a centre is certain to be omitted, the search stops and returns
    /// an upper bound.
    double from_traces(Point p, const SegmentGrid& grid) const {
        const double room = left_out_seed_share * spacing_, enough = 0.999 * room * room;
        double least = std::numeric_limits<double>::infinity();  // squared distance
        grid.any_near(p, [&](std::size_t k) {
            least = std::min(least, squared_distance_to(grid.segments()[k], p));
            return least < enough;
        });
        return std::sqrt(least);
    }

    /// Points to be triangulated: centres far enough from traces, and the wall points of the mesh without traces.
    std::vector<ChosenPoint> chosen_points(std::span<const CellCentre> centres, const SegmentGrid& grid) {
        std::vector<CellCentre> kept;
        std::vector<int> number;
        std::vector<char> near;
        const double room = left_out_seed_share * spacing_;
        for (std::size_t k = 0; k < centres.size(); ++k) {
            const double away = from_traces(centres[k], grid);
            if (away < room) {
                ++out_.left_out;
                continue;
            }
            kept.push_back(centres[k]);
            number.push_back(static_cast<int>(k));
            near.push_back(away <= near_share * spacing_ ? 1 : 0);
        }
        std::vector<ChosenPoint> points;
        for (const double x : {domain_.x1, domain_.x2})
            for (const double y : {domain_.y1, domain_.y2})
                points.push_back({{x, y}, {-1, from_traces({x, y}, grid) <= near_share * spacing_}});
        if (kept.empty()) return points;
        const Triangles without = points_without_traces(kept, centres, number);
        for (std::size_t k = 0; k < without.points.size(); ++k) {
            const Point p = without.points[k];
            if (without.centre_of[k] >= 0) {
                const auto centre = static_cast<std::size_t>(without.centre_of[k]);
                points.push_back({p, {number[centre], near[centre] != 0}});
                continue;
            }
            if ((p.x == domain_.x1 || p.x == domain_.x2) && (p.y == domain_.y1 || p.y == domain_.y2)) continue;
            const double away = from_traces(p, grid);
            if (away >= room) points.push_back({p, {-1, away <= near_share * spacing_}});
        }
        return points;
    }

    /// Points of the mesh without traces. @param number index of each kept centre among the given centres, for error
    /// messages
    Triangles points_without_traces(std::span<const CellCentre> kept, std::span<const CellCentre> given,
                                    const std::vector<int>& number) const {
        try {
            return delaunay_points(kept, domain_, patience_);
        } catch (const MeshError& error) {
            if (error.centres.size() != 2) throw;
            throw coincident_centres(given, number[static_cast<std::size_t>(error.centres[0])],
                                     number[static_cast<std::size_t>(error.centres[1])]);
        }
    }

    void insert_points(const std::vector<ChosenPoint>& points) {
        // A point and either the index of a chosen point, or ~index of a point on a trace. Pairs are kept small, so
        // that they can be sorted quickly.
        using Placed = std::pair<Kernel::Point_2, int>;
        std::vector<Placed> order;
        order.reserve(points.size() + 2 * pieces_.size());
        for (const ChosenPoint& one : points)
            order.emplace_back(Kernel::Point_2(one.place.x, one.place.y), static_cast<int>(order.size()));
        for (const TracePiece& piece : pieces_) {
            order.emplace_back(Kernel::Point_2(piece.a.x, piece.a.y), ~piece.from);
            order.emplace_back(Kernel::Point_2(piece.b.x, piece.b.y), ~piece.to);
        }
        using PlaceOf = CGAL::First_of_pair_property_map<Placed>;
        CGAL::spatial_sort(order.begin(), order.end(), CGAL::Spatial_sort_traits_adapter_2<Kernel, PlaceOf>());
        Unconstrained points_alone;  // has no constraints, so that edge flips need not check for them
        ConstrainedFace hint;
        for (const auto& [place, which] : order) {
            patience_.piece();
            // A point on a trace occurs once per piece. If it has already been inserted, locating it again would
            // require exact arithmetic.
            ConstrainedVertex v = which < 0 ? vertex(~which) : ConstrainedVertex();
            if (v == ConstrainedVertex()) {
                const std::size_t before = points_alone.number_of_vertices();
                v = points_alone.insert(place, hint);
                const PointInfo info = which < 0 ? PointInfo{} : points[static_cast<std::size_t>(which)].info;
                // A point on a trace may coincide with a corner.
                if (points_alone.number_of_vertices() != before || info.centre < 0) v->info() = info;
                if (which < 0) vertex(~which) = v;
            }
            hint = v->face();
        }
        mesh_.swap(points_alone);
    }
    ConstrainedVertex& vertex(int point) { return vertices_[static_cast<std::size_t>(point)]; }

    void constrain() {
        for (const TracePiece& piece : pieces_) constrain(vertex(piece.from), vertex(piece.to));
        // The walls are the edges of the convex hull.
        auto round = mesh_.incident_vertices(mesh_.infinite_vertex());
        const auto start = round;
        std::vector<ConstrainedVertex> around;
        do around.push_back(round);
        while (++round != start);
        for (std::size_t k = 0; k < around.size(); ++k) constrain(around[k], around[(k + 1) % around.size()]);
    }
    void constrain(ConstrainedVertex a, ConstrainedVertex b) {
        ConstrainedFace face;
        int k = 0;
        if (!mesh_.is_edge(a, b, face, k)) {
            mesh_.insert_constraint(a, b);
            return;
        }
        face->set_constraint(k, true);
        face->neighbor(k)->set_constraint(mesh_.mirror_index(face, k), true);
    }

    void refine() {
        mesh_.list_constraints();
        CGAL::Delaunay_mesher_2<Constrained, NearTraceCriteria> mesher(mesh_, NearTraceCriteria(smallest_squared_sine));
        mesher.init();
        // Equivalent to CGAL's refine_mesh(), but meshing can be cancelled between steps.
        while (mesher.step_by_step_refine_mesh()) patience_.piece();
    }

    /// Marks the constrained edges between a and b, into which refinement has split a piece, as belonging to the trace.
    void note_trace(ConstrainedVertex a, ConstrainedVertex b, int trace) {
        const Point end = place_of(b);
        const Point from = place_of(a);
        const double whole = distance(from, end);
        while (a != b) {
            ConstrainedFace beside;
            int opposite = 0;
            if (mesh_.is_edge(a, b, beside, opposite) && beside->is_constrained(opposite)) {
                mark(beside, opposite, trace);
                return;
            }
            const Point here = place_of(a);
            ConstrainedVertex best = nullptr;
            Constrained::Edge best_edge;
            double least = 1e-6 * whole;  // largest allowed distance from the line; other traces are much farther away
            auto edge = mesh_.incident_edges(a);
            const auto start = edge;
            do {
                const ConstrainedFace face = edge->first;
                const int k = edge->second;
                if (mesh_.is_infinite(*edge) || !mesh_.is_constrained(*edge)) continue;
                const ConstrainedVertex ccw = face->vertex(Constrained::ccw(k)), cw = face->vertex(Constrained::cw(k));
                const ConstrainedVertex other = ccw == a ? cw : ccw;
                const Point there = place_of(other);
                const double ahead = (there.x - here.x) * (end.x - from.x) + (there.y - here.y) * (end.y - from.y);
                const double beyond = (end.x - there.x) * (end.x - from.x) + (end.y - there.y) * (end.y - from.y);
                if (ahead <= 0.0 || beyond < 0.0) continue;
                const double off =
                    std::abs((end.x - from.x) * (there.y - from.y) - (end.y - from.y) * (there.x - from.x)) / whole;
                if (off >= least) continue;
                least = off;
                best = other;
                best_edge = *edge;
            } while (++edge != start);
            if (best == ConstrainedVertex(nullptr))
                throw MeshError(
                    fmt::format("mesh: found trace {} at ({:.9g}, {:.9g}) so close to another trace that its edges are "
                                "lost in rounding, expected traces that cross or stay apart; remove one of the two",
                                trace, here.x, here.y));
            mark(best_edge.first, best_edge.second, trace);
            a = best;
        }
    }
    /// Marks an edge as lying on a trace, in each of its two triangles that belongs to the mesh.
    void mark(ConstrainedFace face, int k, int trace) {
        const ConstrainedFace beyond = face->neighbor(k);
        for (const auto& [side, edge] : {std::pair{face, k}, {beyond, beyond->index(face)}})
            if (side->info().value >= 0)
                out_.triangles.traces[static_cast<std::size_t>(side->info().value)][static_cast<std::size_t>(edge)] =
                    trace;
    }

    void number_points() {
        Triangles& t = out_.triangles;
        t.points.reserve(mesh_.number_of_vertices());
        t.centre_of.reserve(mesh_.number_of_vertices());
        for (const ConstrainedVertex v : mesh_.finite_vertex_handles()) {
            v->info().number = static_cast<int>(t.points.size());
            const Point p = place_of(v);
            t.points.push_back(p);
            t.centre_of.push_back(v->info().centre);
            if (v->info().centre < 0 && sides_at(p, domain_) == 0) ++out_.added;
        }
    }

    void collect() {
        Triangles& t = out_.triangles;
        std::vector<ConstrainedFace> faces;
        faces.reserve(mesh_.number_of_faces());
        for (const ConstrainedFace face : mesh_.finite_face_handles()) {
            face->info().value = static_cast<int>(faces.size());
            faces.push_back(face);
        }
        t.corners.reserve(faces.size());
        t.neighbours.reserve(faces.size());
        for (const ConstrainedFace face : faces) {
            auto& corners = t.corners.emplace_back();
            auto& neighbours = t.neighbours.emplace_back();
            for (int k = 0; k < 3; ++k) {
                const auto at = static_cast<std::size_t>(k);
                corners[at] = face->vertex(k)->info().number;
                neighbours[at] = face->neighbor(k)->info().value;
            }
        }
        t.traces.assign(faces.size(), {-1, -1, -1});
        for (const TracePiece& piece : pieces_) note_trace(vertex(piece.from), vertex(piece.to), piece.trace);
    }

    Rectangle domain_;
    const TraceGraph& graph_;
    Patience& patience_;
    double spacing_;
    std::vector<TracePiece> pieces_;
    std::vector<ConstrainedVertex> vertices_;  // vertex of each point on a trace, by index of the point
    Constrained mesh_;
    ConformingTriangles out_;
};

}  // namespace

ConformingTriangles conforming_triangles(std::span<const CellCentre> centres, const Rectangle& domain,
                                         const TraceGraph& graph, double spacing, Patience& patience) {
    return Conforming(domain, graph, spacing, patience).make(centres);
}

}  // namespace crackle
