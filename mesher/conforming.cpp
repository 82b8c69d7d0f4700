// SPDX-License-Identifier: GPL-3.0-or-later
// Traces are cut into pieces about as long as the centres are apart; centres within 0.4 of that of a trace are left
// out, for triangles on the trace with them would be flat; wall points come from the mesh without traces. CGAL's
// mesher then splits pieces until each has an empty diametral circle, and adds circumcentres where a triangle near a
// trace has a small angle. Away from traces the triangles stay those of the centres.

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

// Shares of the spacing. A triangle on a piece one spacing long whose apex is 0.4 off has angles above 21 degrees.
constexpr double left_out_seed_share = 0.4;
constexpr double near_share = 1.3;  // within it triangles are looked at: the first row beside the trace
// Passages narrower than that share, and angles below that sine (of a degree), would be filled with triangles as small.
constexpr double narrowest_share = 0.02, least_sine = 0.0175;
constexpr double smallest_squared_sine = 0.125;  // of 20.7 degrees: up to that refinement is sure to end

struct PointInfo {
    int centre = -1;
    bool near_trace = true;  // also of points that refinement adds
    int number = -1;         // among the mesh's points
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using TracedVertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<PointInfo, Kernel, CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
struct FaceNumber {
    int value = -1;  // of the triangle; of what lies outside of the mesh -1
};
using TracedFaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceNumber, Kernel, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using TracedStructure = CGAL::Triangulation_data_structure_2<TracedVertexBase, TracedFaceBase>;
using Unconstrained = CGAL::Delaunay_triangulation_2<Kernel, TracedStructure>;
using ConstrainedBase = CGAL::Constrained_Delaunay_triangulation_2<Kernel, TracedStructure, CGAL::Exact_predicates_tag>;
/// Lists its constrained edges, so that CGAL's mesher, before it begins, need not look for them round every vertex.
class Constrained : public ConstrainedBase {
  public:
    // What the mesher asks of one that lists them.
    using Constraint_hierarchy_tag = CGAL::Tag_true;
    using Listed = std::vector<std::pair<std::pair<Vertex_handle, Vertex_handle>, bool>>;
    using Subconstraint_iterator = Listed::const_iterator;
    Subconstraint_iterator subconstraints_begin() const { return listed_.begin(); }
    Subconstraint_iterator subconstraints_end() const { return listed_.end(); }
    void split_constraint(Vertex_handle, Vertex_handle, Vertex_handle) const {}  // the list is read once

    void list_constraints();

  private:
    Listed listed_;
};
using ConstrainedVertex = Constrained::Vertex_handle;
using ConstrainedFace = Constrained::Face_handle;

Point place_of(ConstrainedVertex v) { return {v->point().x(), v->point().y()}; }

/// Whether two edges from one place may meet at less than 60 degrees, whatever the rounding.
bool meet_sharply(Point u, Point v) {
    const double along = dot(u, v);
    return !(along <= 0.0 || 4.0 * along * along < 0.999 * dot(u, u) * dot(v, v));
}

/// Those that the mesher may have to do with: at a sharp angle to another, or with a point in their diametral circle.
/// In the order of the edges, in which it splits them.
void Constrained::list_constraints() {
    struct Arm {
        crackle::Point along;
        int next;  // at the same vertex; -1: none
    };
    std::vector<Edge> edges;
    std::vector<Arm> arms;
    std::vector<int> last;                                                          // arm, by vertex
    std::vector<char> sharp;                                                        // by vertex
    const auto number = [&](Vertex_handle v) -> int& { return v->info().number; };  // no point has another yet
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

/// CGAL's criterion for triangles near a trace; others are good.
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
    int from, to;  // among the traces' points
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
        int points = static_cast<int>(graph_.nodes.size());  // those between nodes come after them
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
        const std::string beside = other < 0 ? "a wall" : other == trace ? "itself" : fmt::format("trace {}", other);
        throw MeshError(
            fmt::format("mesh: found trace {} and {} {} at ({:.9g}, {:.9g}), expected traces at least {:.4g} "
                        "apart ({} of the mean spacing) or meeting at 1 degree or more; remove one, move "
                        "it, or make the particles smaller",
                        trace, beside, what, at.x, at.y, narrowest_share * spacing_, narrowest_share),
            {}, std::move(named));
    }

    /// Two straight pieces that do not meet are nearest at an end of one.
    void refuse_narrow_passages(const SegmentGrid& grid) const {
        const double narrow = narrowest_share * spacing_;
        for (const TracePiece& piece : pieces_) {
            for (const auto& ends : {std::pair{piece.a, piece.b}, {piece.b, piece.a}}) {
                const auto &end = ends.first, &start = ends.second;  // clang++ 14 captures no structured bindings
                // Between nodes the piece before has been here.
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
    /// @param at  where both pieces begin
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

    /// Beyond near_share something beyond; where a centre is left out, no more than what leaves it out.
    double from_traces(Point p, const SegmentGrid& grid) const {
        const double room = left_out_seed_share * spacing_, enough = 0.999 * room * room;
        double least = std::numeric_limits<double>::infinity();  // squared
        grid.any_near(p, [&](std::size_t k) {
            least = std::min(least, squared_distance_to(grid.segments()[k], p));
            return least < enough;
        });
        return std::sqrt(least);
    }

    /// Centres far enough from traces, and what the walls have of points without traces.
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

    /// @param number  of each that is kept among the given centres, by which errors name it
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
        using Placed = std::pair<Kernel::Point_2, int>;  // small, to be sorted: a chosen point, or ~ one of the traces'
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
        Unconstrained points_alone;  // its flips look after no constraints
        ConstrainedFace hint;
        for (const auto& [place, which] : order) {
            patience_.piece();
            // A trace's point comes once a piece: where it is already, locating it would take exact arithmetic.
            ConstrainedVertex v = which < 0 ? vertex(~which) : ConstrainedVertex();
            if (v == ConstrainedVertex()) {
                const std::size_t before = points_alone.number_of_vertices();
                v = points_alone.insert(place, hint);
                const PointInfo info = which < 0 ? PointInfo{} : points[static_cast<std::size_t>(which)].info;
                // A trace's point may be a corner.
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
        // The walls are the convex hull.
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
        // What refine_mesh() does, step by step.
        while (mesher.step_by_step_refine_mesh()) patience_.piece();
    }

    /// The constrained edges from a to b, which refinement has split, are the trace's.
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
            double least = 1e-6 * whole;  // off the line: other traces leave at angles that can be seen
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
                    fmt::format("mesh: found trace {} at ({:.9g}, {:.9g}) so close to another that its "
                                "edges are lost in rounding, expected traces apart or crossing; remove one",
                                trace, here.x, here.y));
            mark(best_edge.first, best_edge.second, trace);
            a = best;
        }
    }
    /// On both sides of an edge, those of the mesh.
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
    std::vector<ConstrainedVertex> vertices_;  // by the traces' points
    Constrained mesh_;
    ConformingTriangles out_;
};

}  // namespace

ConformingTriangles conforming_triangles(std::span<const CellCentre> centres, const Rectangle& domain,
                                         const TraceGraph& graph, double spacing, Patience& patience) {
    return Conforming(domain, graph, spacing, patience).make(centres);
}

}  // namespace crackle
