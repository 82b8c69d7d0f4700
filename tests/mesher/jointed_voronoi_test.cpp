// SPDX-License-Identifier: GPL-3.0-or-later
// Tests Voronoi cells with traces: every trace is a chain of edges on its line, and the domain is filled without
// overlap. Random networks are meshed or refused with a message that names traces.

#include "mesher/mirrored_seeds.hpp"
#include "tests/mesher/jointed.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::check;
using testing::distance_from_line;
using testing::jointed_box;
using testing::length_of;
using testing::Lines;
using testing::packing_like;
using testing::TraceCheck;
using testing::within;

MeshRequest cells_with(Lines traces, double gap = 0.0) {
    return testing::with_traces(MeshKind::voronoi, std::move(traces), gap);
}

TEST(JointedVoronoi, EveryTraceIsAChainOfEdgesOnItsLine) {
    for (const Lines& traces :
         {Lines{{{0.2, 0.7}, {0.8, 1.1}}},                                        // two free ends
          Lines{{{0.0, 0.5}, {1.0, 0.9}}},                                        // one from wall to wall
          Lines{{{0.2, 0.5}, {0.8, 0.9}}, {{0.3, 1.0}, {0.6, 0.4}}},              // a crossing
          Lines{{{0.1, 0.4}, {0.5, 0.9}, {0.9, 1.0}}, {{0.5, 0.9}, {0.4, 1.6}}},  // a bend, and a branch
          Lines{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}, {{0.1, 1.2}, {0.5, 1.3}, {0.9, 1.7}}}}) {
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const Mesh mesh = make_mesh(packing_like(seed), jointed_box, cells_with(traces));
            const TraceCheck found = check(mesh, traces);
            EXPECT_TRUE(within("distance of the edges from the trace", found.off_line, 0.0, 2e-12));
            for (std::size_t t = 0; t < traces.size(); ++t)
                EXPECT_TRUE(
                    agrees("length of a trace", found.length.at(static_cast<int>(t)), length_of(traces[t]), 1e-9));
            EXPECT_TRUE(found.paired) << "each edge has a cell on either side, and both refer to the trace";
            EXPECT_TRUE(agrees("areas", testing::sum_of_areas(mesh), 2.0, 1e-12));
            EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, 2.0));
        }
    }
}

TEST(JointedVoronoi, CellsFarFromTracesAreThoseWithoutThem) {
    const auto centres = packing_like(4);
    const Mesh without = make_mesh(centres, jointed_box, cells_with({})),
               with = make_mesh(centres, jointed_box, cells_with({{{0.2, 0.2}, {0.8, 0.4}}}));
    std::set<std::vector<std::pair<double, double>>> cells;
    const auto corners_of = [](const Mesh& mesh, const Cell& cell) {
        std::vector<std::pair<double, double>> corners;
        // The round-off of a circumcentre depends on the corner from which it is computed.
        for (const Point p : mesh.outline(cell)) corners.emplace_back(std::round(1e9 * p.x), std::round(1e9 * p.y));
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        return corners;
    };
    const auto far = [](const Mesh& mesh, const Cell& cell) {
        const auto corners = mesh.outline(cell);
        return std::all_of(corners.begin(), corners.end(), [](Point p) { return p.y > 0.8; });
    };
    for (const Cell& cell : without.cells)
        if (far(without, cell)) cells.insert(corners_of(without, cell));
    std::size_t same = 0;
    for (const Cell& cell : with.cells)
        if (far(with, cell)) same += cells.count(corners_of(with, cell));
    EXPECT_EQ(same, cells.size());
    EXPECT_GT(same, 400U);
}

TEST(JointedVoronoi, CellsAlongATraceAreAboutAsLargeAsOthers) {
    const Mesh mesh =
        make_mesh(packing_like(5), jointed_box, cells_with({{{0.2, 0.5}, {0.8, 0.9}}, {{0.3, 1.0}, {0.6, 0.4}}}));
    double least = 1e300, most = 0.0;
    for (const Cell& cell : mesh.cells) least = std::min(least, cell.area), most = std::max(most, cell.area);
    const double mean = 2.0 / static_cast<double>(mesh.cells.size());
    fmt::print("  areas of {} cells from {:.3g} to {:.3g} of their mean\n", mesh.cells.size(), least / mean,
               most / mean);
    EXPECT_GT(least, 0.15 * mean);
    EXPECT_LT(most, 3.0 * mean);
}

TEST(JointedVoronoi, BesideATraceAloneLieThePackingsOwnSeedsAndTheirImages) {
    const std::vector<Point> line{{0.2, 0.7}, {0.8, 1.1}};
    const auto centres = packing_like(8);
    const double spacing = std::sqrt(2.0 / static_cast<double>(centres.size()));
    const TraceGraph graph = trace_graph(jointed_box, Lines{line}, 0.0);
    const SeedSet set =
        mirrored_seeds(centres, jointed_box, graph, spacing, std::vector<double>(graph.edges.size(), 1.0));
    const double length = distance(line[0], line[1]);
    const Point along{(line[1].x - line[0].x) / length, (line[1].y - line[0].y) / length};
    int pairs = 0, own = 0;
    for (std::size_t k = 0; k < set.places.size(); ++k) {
        const Point p = set.places[k];
        const double s = (p.x - line[0].x) * along.x + (p.y - line[0].y) * along.y,
                     off = (p.y - line[0].y) * along.x - (p.x - line[0].x) * along.y;
        if (set.added[k] == 0) continue;
        if (off > 1e-9 && s > spacing && s < length - spacing) {
            ++pairs;
            own += distance(p, centres[static_cast<std::size_t>(set.centre[k])]) < 1e-12 ? 1 : 0;
        }
        const Point image{p.x + 2.0 * off * along.y, p.y - 2.0 * off * along.x};
        EXPECT_TRUE(std::any_of(set.places.begin(), set.places.end(), [&](Point q) {
            return distance(q, image) < 1e-12;
        })) << k;
    }
    fmt::print("  {} of {} seeds beside the trace are the packing's own\n", own, pairs);
    EXPECT_GE(pairs, static_cast<int>(length / spacing) - 2);
    EXPECT_GE(own, 2 * pairs / 3);
}

TEST(JointedVoronoi, EdgesOfTheInsetMeshKnowTheirTrace) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}};
    const Mesh apart = make_mesh(packing_like(5), jointed_box, cells_with(traces, 1e-3));
    double length = 0.0;
    for (const Cell& cell : apart.cells) {
        const auto corners = apart.outline(cell);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int trace = apart.edge_traces[cell.first_corner + k];
            if (trace < 0) continue;
            const auto& line = traces[static_cast<std::size_t>(trace)];
            EXPECT_NEAR(distance_from_line(line[0], line[1], corners[k]), 5e-4, 1e-12);
            length += 0.5 * distance(corners[k], corners[(k + 1) % corners.size()]);
        }
    }
    // Each edge is shortened by about half a gap at either end.
    const double whole = length_of(traces[0]) + length_of(traces[1]);
    EXPECT_TRUE(within("length of the inset edges", length,
                       whole - 0.5e-3 * static_cast<double>(apart.report.trace_edges) / 2.0, 0.02 * whole));
}

TEST(JointedVoronoi, SameInputSameBytes) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}, {{0.1, 1.2}, {0.9, 1.25}}};
    const auto centres = packing_like(7);
    const Mesh once = make_mesh(centres, jointed_box, cells_with(traces)),
               again = make_mesh(centres, jointed_box, cells_with(traces));
    EXPECT_EQ(once.corners, again.corners);
    EXPECT_EQ(once.edge_traces, again.edge_traces);
}

TEST(JointedVoronoi, RandomNetworksAreMeshedOrRefusedByName) {
    const testing::NetworkCount count = testing::mesh_random_networks(MeshKind::voronoi, 400);
    EXPECT_GT(count.meshed, 180);
    EXPECT_GT(count.cut, 80);
    EXPECT_GT(count.refused, 20);
}

TEST(JointedVoronoi, MergingIsRefused) {
    MeshRequest request = cells_with({{{0.2, 0.2}, {0.8, 0.4}}});
    request.merge_destroyed = true;
    EXPECT_THROW(make_mesh(packing_like(1), jointed_box, request), MeshError);
}

}  // namespace
}  // namespace crackle
