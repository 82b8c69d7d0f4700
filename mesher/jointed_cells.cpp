// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/jointed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesher/place_grid.hpp"

namespace crackle {
namespace {

// Each time that cells do not cover a trace, those along it become narrower by that factor, down to that share.
constexpr double shrink_factor = 0.6, least_shrink = 0.2;
constexpr double shortest_edge_share = 0.1;  // of the spacing: between two nodes of a trace
// Of the largest coordinate: an edge of a cell lies on a trace by its seeds, to the rounding of circumcentres.
constexpr double on_trace_share = 1e-12;
constexpr double covered_share = 1e-9;  // of an edge's length that may be missing

class JointedPartition {
  public:
    JointedPartition(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                     double spacing, Patience& patience)
        : centres_(centres),
          domain_(domain),
          graph_(graph),
          patience_(patience),
          spacing_(spacing),
          near_(on_trace_share * coordinate_scale(domain)),
          grid_(segments(), 0.5 * spacing),
          shrink_(graph.edges.size(), 1.0) {}

    JointedCells make() {
        for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
            const Segment& s = grid_.segments()[e];
            if (graph_.edges[e].trace >= 0 && distance(s.a, s.b) < shortest_edge_share * spacing_) refuse(e);
        }
        while (true) {
            patience_.ask();
            JointedCells made;
            made.seeds = mirrored_seeds(centres_, domain_, graph_, spacing_, shrink_);
            std::set<std::size_t> failing;
            try {
                made.cells = voronoi_cells(made.seeds.places, domain_, patience_);
                failing = mark_traces(made);
                if (failing.empty()) return made;
            } catch (const MeshError& error) {
                failing = edges_at(made.seeds, error);
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

    /// @return edges of the graph that cells do not cover
    std::set<std::size_t> mark_traces(JointedCells& made) const {
        made.traces.assign(made.cells.corners.size(), -1);
        std::vector<double> covered(graph_.edges.size(), 0.0);
        for (const VoronoiCells::Range& cell : made.cells.cells) {
            if (made.seeds.added[static_cast<std::size_t>(cell.centre)] == 0) continue;
            const auto outline = made.cells.outline(cell);
            for (std::size_t k = 0; k < outline.size(); ++k) {
                const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
                grid_.each_near({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, [&](std::size_t e) {
                    if (graph_.edges[e].trace < 0) return;
                    const Segment& s = grid_.segments()[e];
                    if (distance_to(s, a) > near_ || distance_to(s, b) > near_) return;
                    made.traces[cell.first + k] = graph_.edges[e].trace;
                    covered[e] += 0.5 * distance(a, b);
                });
            }
        }
        std::set<std::size_t> failing;
        for (std::size_t e = 0; e < covered.size(); ++e) {
            if (graph_.edges[e].trace < 0) continue;
            const Segment& s = grid_.segments()[e];
            const double length = distance(s.a, s.b);
            if (std::abs(covered[e] - length) > covered_share * length + 4.0 * near_) failing.insert(e);
        }
        return failing;
    }

    /// Edges near the seeds that an error names, where one of these belongs to a trace.
    std::set<std::size_t> edges_at(const SeedSet& seeds, const MeshError& error) const {
        std::set<std::size_t> failing;
        for (const int seed : error.centres) {
            const auto number = static_cast<std::size_t>(seed);
            if (seeds.added[number] == 0) continue;
            grid_.each_near(seeds.places[number], [&](std::size_t e) {
                if (graph_.edges[e].trace >= 0) failing.insert(e);
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
            if (shrink_[e] * shrink_factor < least_shrink) refuse(e);
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
                        "within {:.3g}, expected room for cells of {} of the mean spacing beside it; remove "
                        "one, move it, make the particles smaller, or take Delaunay triangles",
                        trace, s.a.x, s.a.y, s.b.x, s.b.y, others.size(), others.size() == 1 ? "" : "s", 0.5 * spacing_,
                        least_shrink),
            {}, std::move(named));
    }

    std::span<const CellCentre> centres_;
    Rectangle domain_;
    const TraceGraph& graph_;
    Patience& patience_;
    double spacing_, near_;
    SegmentGrid grid_;
    std::vector<double> shrink_;  // by edge
};

}  // namespace

JointedCells jointed_cells(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                           double spacing, Patience& patience) {
    return JointedPartition(centres, domain, graph, spacing, patience).make();
}

}  // namespace crackle
