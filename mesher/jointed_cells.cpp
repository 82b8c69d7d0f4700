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

// Each time that cells do not cover a trace, those along it become narrower by that factor, down to that share.
constexpr double shrink_factor = 0.6, least_shrink = 0.2;
constexpr double shortest_edge_share = 0.1;  // of the spacing: between two nodes of a trace
// Of the largest coordinate: an edge of a cell lies on a trace by its seeds, to the rounding of circumcentres.
constexpr double on_trace_share = 1e-12;
// Of the mean cell: pieces as small stay where nothing else gives a mesh, at a time step some twenty times shorter.
constexpr double tolerated_piece_share = 0.002;
constexpr double covered_share = 1e-9;  // of an edge's length that may be missing

class JointedPartition {
  public:
    JointedPartition(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                     double spacing, double least_piece_share, Patience& patience)
        : centres_(centres),
          domain_(domain),
          graph_(graph),
          patience_(patience),
          spacing_(spacing),
          least_piece_share_(least_piece_share),
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

    /// Along the edges that do not cut.
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

    /// Rows of cells narrower than a piece may be make the time step small: the traces there cut, where that is better.
    JointedCells without_small_cells(JointedCells made) {
        const std::set<std::size_t> small = edges_of_small_cells(made);
        if (small.empty()) return with_cuts(std::move(made));
        JointedPartition cutting(*this);
        for (const std::size_t e : small) cutting.cuts_[e] = 1;
        try {
            return cutting.make();
        } catch (const MeshError&) {  // of pieces smaller still
            return with_cuts(std::move(made));
        }
    }
    /// On whose rows cells are smaller than a piece may be.
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
        made.traced = cut_cells(made.traced, domain_, graph_, cut_by, spacing_, least_piece_share_, patience_);
        number_pieces(made);
        return made;
    }
    /// So many cuts of a cell that its pieces are smaller than asked.
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
    /// A seed a cell, in the order of the seeds that they grew from.
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

    /// Calls use(edge of the graph, length) where the edge between two corners lies on a trace.
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
    /// Surely, as most corners are: cheaper than the distance.
    bool off_line(const Segment& s, Point p) const {
        const Point d{s.b.x - s.a.x, s.b.y - s.a.y};
        const double off = cross(d, {p.x - s.a.x, p.y - s.a.y});
        return off * off > 4.0 * near_ * near_ * dot(d, d);
    }
    bool is_covered(std::size_t e, double covered) const {
        const double length = distance(grid_.segments()[e].a, grid_.segments()[e].b);
        return std::abs(covered - length) <= covered_share * length + 4.0 * near_;
    }

    /// @return edges of the graph that cells do not cover
    std::set<std::size_t> mark_traces(JointedCells& made) const {
        const VoronoiCells& cells = made.traced.cells;
        made.traced.traces.assign(cells.corners.size(), -1);
        std::vector<double> covered(graph_.edges.size(), 0.0);
        for (const VoronoiCells::Range& cell : cells.cells) {
            if (made.seeds.added[static_cast<std::size_t>(cell.centre)] == 0) continue;
            const auto outline = cells.outline(cell);
            // An edge on a trace has both ends there: what is near every other corner is enough.
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

    /// Edges near the seeds that an error names, where one of these belongs to a trace.
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
        throw MeshError(
            fmt::format("mesh: found trace {} from ({:.9g}, {:.9g}) to ({:.9g}, {:.9g}) with {} other trace{} "
                        "within {:.3g}, expected one that cells can follow; remove one, move it, or make the "
                        "particles smaller",
                        trace, s.a.x, s.a.y, s.b.x, s.b.y, others.size(), others.size() == 1 ? "" : "s",
                        0.5 * spacing_),
            {}, std::move(named));
    }

    std::span<const CellCentre> centres_;
    Rectangle domain_;
    const TraceGraph& graph_;
    Patience& patience_;
    double spacing_, least_piece_share_, near_;
    SegmentGrid grid_;
    std::vector<double> shrink_;  // by edge
    std::vector<char> cuts_;      // whether an edge has no rows and cuts
};

}  // namespace

JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience) {
    try {
        return JointedPartition(centres, domain, graph, spacing, smallest_piece_share, patience).make();
    } catch (const MeshError&) {  // small pieces are better than none: they cost time steps
        return JointedPartition(centres, domain, graph, spacing, tolerated_piece_share, patience).make();
    }
}

}  // namespace crackle
