// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/jointed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "mesher/inset.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {
namespace {

// If cells do not cover a trace, the rows along it are made narrower by shrink_factor, repeatedly if necessary, but not
// below least_shrink.
constexpr double shrink_factor = 0.6, least_shrink = 0.2;
constexpr double shortest_edge_share =
    0.1;  // trace edges shorter than this, relative to the spacing, get no rows and cut cells instead
// Tolerance for an edge to lie on a trace, relative to the largest coordinate. Mirrored seeds place an edge on the
// trace up to the round-off of circumcentres.
constexpr double on_trace_share = 1e-12;
// Smallest area of a piece, relative to the mean cell area, that is accepted if there is no mesh without such small
// pieces. The time step is then about 20 times smaller.
constexpr double tolerated_piece_share = 0.002;
// Largest fraction of an edge's length that may be uncovered if the edge counts as covered.
constexpr double covered_share = 1e-9;

class JointedPartition {
  public:
    JointedPartition(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                     double spacing, SmallPieces small_pieces, Patience& patience)
        : centres_(centres),
          domain_(domain),
          graph_(graph),
          patience_(patience),
          spacing_(spacing),
          small_pieces_(small_pieces),
          near_(on_trace_share * coordinate_scale(domain)),
          grid_(segments(), 0.5 * spacing),
          shrink_(graph.edges.size(), 1.0),
          cuts_(graph.edges.size(), 0) {}

    JointedCells make() {
        for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
            const Segment& s = grid_.segments()[e];
            if (graph_.edges[e].trace >= 0 && distance(s.a, s.b) < shortest_edge_share * spacing_) cuts_[e] = 1;
        }
        while (true) {
            patience_.ask();
            refuse_crowds();
            JointedCells made;
            made.seeds = seeds_of_rows();
            std::set<std::size_t> failing;
            try {
                made.traced.cells = voronoi_cells(made.seeds.places, domain_, patience_);
                failing = mark_traces(made);
                if (failing.empty()) return without_small_cells(std::move(made));
            } catch (const MeshError& error) {
                failing = edges_at(made.seeds, error);
                if (failing.empty() && error.centres.empty()) throw;
                if (failing.empty()) throw of_given(made.seeds, error);
            }
            shrink(failing);
        }
    }

  private:
    std::vector<Segment> segments() const {
        std::vector<Segment> all;
        all.reserve(graph_.edges.size());
        for (const TraceGraph::Edge& edge : graph_.edges)
            all.push_back(
                {graph_.nodes[static_cast<std::size_t>(edge.from)], graph_.nodes[static_cast<std::size_t>(edge.to)]});
        return all;
    }

    bool has_rows(std::size_t e) const { return graph_.edges[e].trace >= 0 && cuts_[e] == 0; }

    /// Seeds, with rows along all edges of the graph that do not cut cells.
    SeedSet seeds_of_rows() const {
        TraceGraph rows = graph_;
        rows.edges.clear();
        std::vector<double> shrink;
        for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
            if (cuts_[e] != 0) continue;
            rows.edges.push_back(graph_.edges[e]);
            shrink.push_back(shrink_[e]);
        }
        return mirrored_seeds(centres_, domain_, rows, spacing_, shrink);
    }

    /// Rows with cells below the smallest allowed size require a small time step. This function removes such rows and
    /// lets the traces cut cells instead, unless the pieces would be even smaller.
    JointedCells without_small_cells(JointedCells made) {
        const std::set<std::size_t> small = edges_of_small_cells(made);
        if (small.empty()) return with_cuts(std::move(made));
        JointedPartition cutting(*this);
        for (const std::size_t e : small) cutting.cuts_[e] = 1;
        try {
            return cutting.make();
        } catch (const MeshError&) {  // cutting would give even smaller pieces
            return with_cuts(std::move(made));
        }
    }
    /// Edges of the graph whose rows have cells below the smallest allowed size.
    std::set<std::size_t> edges_of_small_cells(const JointedCells& made) const {
        std::set<std::size_t> edges;
        const VoronoiCells& cells = made.traced.cells;
        for (const VoronoiCells::Range& cell : cells.cells) {
            const auto outline = cells.outline(cell);
            if (polygon_area(outline) >= smallest_piece_share * spacing_ * spacing_) continue;
            for (std::size_t k = 0; k < outline.size(); ++k) {
                if (made.traced.traces[cell.first + k] < 0) continue;
                each_trace_under(outline[k], outline[k + 1 == outline.size() ? 0 : k + 1],
                                 [&](std::size_t e, double) { edges.insert(e); });
            }
        }
        return edges;
    }

    JointedCells with_cuts(JointedCells made) {
        std::vector<std::size_t> cut_by;
        for (std::size_t e = 0; e < cuts_.size(); ++e)
            if (cuts_[e] != 0) cut_by.push_back(e);
        if (cut_by.empty()) return made;
        made.traced = cut_cells(made.traced, domain_, graph_, cut_by, spacing_, small_pieces_, patience_);
        number_pieces(made);
        return made;
    }
    /// Refuses traces so close together that pieces of cut cells would be too small.
    void refuse_crowds() const {
        Squares squares(spacing_);
        for (std::size_t e = 0; e < cuts_.size(); ++e) {
            if (cuts_[e] == 0) continue;
            const Segment& s = grid_.segments()[e];
            const std::int64_t i = squares.index(0.5 * (s.a.x + s.b.x)), j = squares.index(0.5 * (s.a.y + s.b.y));
            squares.add(i, j, e);
            double crowd = 0.0;
            squares.each_at(i, j, [&](std::size_t) { crowd += 1.0; });
            if (crowd > 1.0 / smallest_piece_share) refuse(e);
        }
    }
    /// Gives each cell its own seed. Cells are sorted by original seed.
    static void number_pieces(JointedCells& made) {
        auto& cells = made.traced.cells.cells;
        std::vector<std::size_t> order(cells.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return cells[a].centre < cells[b].centre; });
        SeedSet numbered;
        numbered.left_out = made.seeds.left_out;
        for (const std::size_t k : order) {
            const auto seed = static_cast<std::size_t>(cells[k].centre);
            cells[k].centre = static_cast<int>(numbered.places.size());
            numbered.places.push_back(made.seeds.places[seed]);
            numbered.centre.push_back(made.seeds.centre[seed]);
            numbered.added.push_back(made.seeds.added[seed]);
        }
        made.seeds = std::move(numbered);
    }

    /// Calls use(edge of the graph, length) for each edge of the graph on which the cell edge from a to b lies.
    template <class Use>
    void each_trace_under(Point a, Point b, Use use) const {
        grid_.each_near({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, [&](std::size_t e) {
            if (graph_.edges[e].trace >= 0 && is_on(e, a) && is_on(e, b)) use(e, distance(a, b));
        });
    }
    bool is_on(std::size_t e, Point p) const {
        const Segment& s = grid_.segments()[e];
        return !off_line(s, p) && distance_to(s, p) <= near_;
    }
    /// Whether a point is certainly not on the line. This is cheaper than computing the distance, and true for most
    /// corners.
    bool off_line(const Segment& s, Point p) const {
        const Point d{s.b.x - s.a.x, s.b.y - s.a.y};
        const double off = cross(d, {p.x - s.a.x, p.y - s.a.y});
        return off * off > 4.0 * near_ * near_ * dot(d, d);
    }
    bool is_covered(std::size_t e, double covered) const {
        const double length = distance(grid_.segments()[e].a, grid_.segments()[e].b);
        return std::abs(covered - length) <= covered_share * length + 4.0 * near_;
    }

    /// Marks the cell edges that lie on traces. @return edges of the graph that are not covered by cell edges
    std::set<std::size_t> mark_traces(JointedCells& made) const {
        const VoronoiCells& cells = made.traced.cells;
        made.traced.traces.assign(cells.corners.size(), -1);
        std::vector<double> covered(graph_.edges.size(), 0.0);
        for (const VoronoiCells::Range& cell : cells.cells) {
            if (made.seeds.added[static_cast<std::size_t>(cell.centre)] == 0) continue;
            const auto outline = cells.outline(cell);
            // A cell edge on a trace has both ends on it, so it is sufficient to check every other corner of the cell.
            for (std::size_t corner = 1; corner <= outline.size(); corner += 2) {
                const std::size_t at = std::min(corner, outline.size() - 1);
                grid_.each_near(outline[at], [&](std::size_t e) {
                    if (!is_on(e, outline[at]) || !has_rows(e)) return;
                    for (std::size_t k = corner - 1; k <= at; ++k) {
                        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
                        if (!is_on(e, k < at ? a : b)) continue;
                        made.traced.traces[cell.first + k] = graph_.edges[e].trace;
                        covered[e] += 0.5 * distance(a, b);
                    }
                });
            }
        }
        std::set<std::size_t> failing;
        for (std::size_t e = 0; e < covered.size(); ++e)
            if (has_rows(e) && !is_covered(e, covered[e])) failing.insert(e);
        return failing;
    }

    /// Edges of the graph near the seeds that an error names, if one of these seeds was added for a trace.
    std::set<std::size_t> edges_at(const SeedSet& seeds, const MeshError& error) const {
        std::set<std::size_t> failing;
        for (const int seed : error.centres) {
            const auto number = static_cast<std::size_t>(seed);
            if (seeds.added[number] == 0) continue;
            grid_.each_near(seeds.places[number], [&](std::size_t e) {
                if (has_rows(e)) failing.insert(e);
            });
        }
        return failing;
    }
    MeshError of_given(const SeedSet& seeds, const MeshError& error) const {
        std::vector<int> named;
        std::string text;
        for (const int seed : error.centres) {
            named.push_back(seeds.centre[static_cast<std::size_t>(seed)]);
            text += fmt::format("{}{}", text.empty() ? "" : " and ", named.back());
        }
        return MeshError(fmt::format("mesh: found centres {} at the same place, expected distinct centres; remove one "
                                     "of them",
                                     text),
                         std::move(named));
    }

    void shrink(const std::set<std::size_t>& failing) {
        std::set<int> nodes;
        for (const std::size_t e : failing) {
            if (shrink_[e] * shrink_factor < least_shrink) cuts_[e] = 1;
            shrink_[e] *= shrink_factor;
            nodes.insert(graph_.edges[e].from);
            nodes.insert(graph_.edges[e].to);
        }
        for (std::size_t e = 0; e < shrink_.size(); ++e) {
            const TraceGraph::Edge& edge = graph_.edges[e];
            if (failing.contains(e) || (!nodes.contains(edge.from) && !nodes.contains(edge.to))) continue;
            shrink_[e] = std::max(least_shrink, shrink_[e] * shrink_factor);
        }
    }
    [[noreturn]] void refuse(std::size_t failing) const {
        const Segment& s = grid_.segments()[failing];
        const Point middle{0.5 * (s.a.x + s.b.x), 0.5 * (s.a.y + s.b.y)};
        const int trace = graph_.edges[failing].trace;
        std::set<int> others;
        for (const Point p : {s.a, middle, s.b}) {
            grid_.each_near(p, [&](std::size_t e) {
                if (graph_.edges[e].trace >= 0 && graph_.edges[e].trace != trace) others.insert(graph_.edges[e].trace);
            });
        }
        std::vector<int> named{trace};
        named.insert(named.end(), others.begin(), others.end());
        throw MeshError(fmt::format("mesh: found no cells that follow trace {} from ({:.9g}, {:.9g}) to ({:.9g}, "
                                    "{:.9g}), which has {} other trace{} within a distance of {:.3g}; remove or move "
                                    "one of these traces, or use smaller particles",
                                    trace, s.a.x, s.a.y, s.b.x, s.b.y, others.size(), others.size() == 1 ? "" : "s",
                                    0.5 * spacing_),
                        {}, std::move(named));
    }

    std::span<const CellCentre> centres_;
    Rectangle domain_;
    const TraceGraph& graph_;
    Patience& patience_;
    double spacing_;
    SmallPieces small_pieces_;
    double near_;
    SegmentGrid grid_;
    std::vector<double> shrink_;  // for each edge of the graph, factor on the width of its rows
    std::vector<char> cuts_;      // for each edge of the graph, whether it has no rows and cuts cells instead
};

}  // namespace

JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience) {
    const auto make = [&](SmallPieces small_pieces) {
        return JointedPartition(centres, domain, graph, spacing, small_pieces, patience).make();
    };
    // Small pieces are accepted if there is no other mesh; they only require a smaller time step.
    for (const SmallPieces small_pieces : {SmallPieces{smallest_piece_share, false}, {tolerated_piece_share, false}}) {
        try {
            return make(small_pieces);
        } catch (const MeshError&) {  // the next attempt accepts smaller pieces or divides them again
        }
    }
    return make({tolerated_piece_share, true});
}

}  // namespace crackle
