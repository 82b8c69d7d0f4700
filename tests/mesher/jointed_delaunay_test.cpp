// SPDX-License-Identifier: GPL-3.0-or-later
// Tests Delaunay triangles with traces: every trace is a chain of edges on its line, the domain is filled without
// overlap, and angles are acceptable. Random networks are meshed or refused with a message that names traces.

#include <algorithm>
#include <map>
#include <random>
#include <set>

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

MeshRequest triangles_with(Lines traces, double gap = 0.0) {
    return testing::with_traces(MeshKind::delaunay, std::move(traces), gap);
}

TEST(JointedDelaunay, EveryTraceIsAChainOfEdgesOnItsLine) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}, {{0.1, 1.2}, {0.5, 1.3}, {0.9, 1.7}}};
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Mesh mesh = make_mesh(packing_like(seed), jointed_box, triangles_with(traces));
        const TraceCheck found = check(mesh, traces);
        EXPECT_TRUE(within("distance of the edges from the trace", found.off_line, 0.0, 2e-12));
        double sum = 0.0;
        for (std::size_t t = 0; t < traces.size(); ++t) {
            sum += length_of(traces[t]);
            EXPECT_TRUE(agrees("length of a trace", found.length.at(static_cast<int>(t)), length_of(traces[t]), 1e-12));
        }
        EXPECT_TRUE(agrees("length reported", mesh.report.trace_length, sum, 1e-12));
        EXPECT_TRUE(found.paired) << "each edge has a triangle on either side, and both refer to the trace";
        EXPECT_TRUE(agrees("areas", testing::sum_of_areas(mesh), 2.0, 1e-12));
        EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, 2.0));
        EXPECT_GT(found.smallest_angle, 20.0);
        EXPECT_EQ(mesh.report.ends_moved, 0);
    }
}

TEST(JointedDelaunay, TrianglesFarFromTracesAreThoseWithoutThem) {
    const auto centres = packing_like(4);
    MeshRequest plain = triangles_with({});
    const Mesh without = make_mesh(centres, jointed_box, plain);
    const Mesh with = make_mesh(centres, jointed_box, triangles_with({{{0.2, 0.2}, {0.8, 0.4}}}));
    const auto set_of = [](const Mesh& mesh) {
        std::set<std::array<int, 3>> triangles;
        for (const Cell& cell : mesh.cells) {
            auto centres_of = cell.centres;
            std::sort(centres_of.begin(), centres_of.end());
            const auto corners = mesh.outline(cell);
            if (std::all_of(corners.begin(), corners.end(), [](Point p) { return p.y > 0.8; }))
                triangles.insert(centres_of);
        }
        return triangles;
    };
    EXPECT_EQ(set_of(without), set_of(with));
    EXPECT_TRUE(without.edge_traces.empty());
}

TEST(JointedDelaunay, EdgesOfTheInsetMeshKnowTheirTrace) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}};
    const auto centres = packing_like(5);
    const Mesh whole = make_mesh(centres, jointed_box, triangles_with(traces)),
               apart = make_mesh(centres, jointed_box, triangles_with(traces, 1e-3));
    ASSERT_EQ(whole.cells.size(), apart.cells.size());
    EXPECT_EQ(whole.edge_traces, apart.edge_traces);  // triangles keep their three edges
    EXPECT_EQ(apart.report.trace_edges,
              std::count_if(apart.edge_traces.begin(), apart.edge_traces.end(), [](int t) { return t >= 0; }));
    // Edges are inset from the trace by half the gap.
    for (const Cell& cell : apart.cells) {
        const auto corners = apart.outline(cell);
        for (std::size_t k = 0; k < 3; ++k) {
            const int trace = apart.edge_traces[cell.first_corner + k];
            if (trace < 0) continue;
            const auto& line = traces[static_cast<std::size_t>(trace)];
            EXPECT_NEAR(distance_from_line(line[0], line[1], corners[k]), 5e-4, 1e-12);
        }
    }
}

TEST(JointedDelaunay, MergingNeverCrossesATrace) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.2, 0.0}, {0.9, 2.0}}};
    MeshRequest request = triangles_with(traces, 4e-4);
    request.merge_destroyed = true;
    std::int64_t merged = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        try {
            const Mesh mesh = make_mesh(testing::random_seeds(800, jointed_box, seed), jointed_box, request);
            merged += mesh.report.cells_destroyed;
            EXPECT_TRUE(agrees("length on traces", mesh.report.trace_length,
                               length_of(traces[0]) + length_of(traces[1]), 1e-12));
            EXPECT_TRUE(agrees("area", mesh.report.area_before_inset, 2.0, 1e-12));
        } catch (const MeshError& error) {  // a sliver among random centres that forms a convex union with no neighbour
            EXPECT_NE(std::string(error.what()).find("forms a convex polygon"), std::string::npos);
        }
    }
    EXPECT_GT(merged, 0);
}

TEST(JointedDelaunay, ATriangleBetweenTracesThatMergesWithNoneNamesThem) {
    // At the tip of a wedge of 3 degrees, an inset of 4 mm leaves nothing.
    MeshRequest request = triangles_with({{{0.2, 1.0}, {0.8, 1.0}}, {{0.2, 1.0}, {0.8, 1.0 + 0.6 * 0.05}}}, 8e-3);
    request.merge_destroyed = true;
    try {
        make_mesh(packing_like(5), jointed_box, request);
        FAIL() << "meshed";
    } catch (const MeshError& error) {
        const std::string text = error.what();
        fmt::print("  {}\n", text);
        EXPECT_NE(text.find("forms a convex polygon"), std::string::npos);
        EXPECT_EQ(error.traces, (std::vector<int>{0, 1}));
        EXPECT_NE(text.find(" next to traces 0, 1 destroyed"), std::string::npos);
    }
}

TEST(JointedDelaunay, EndsNearOtherTracesMeetThem) {
    // One trace ends 0.01 before the other, and one before the wall; the spacing is 0.05.
    const Mesh mesh =
        make_mesh(packing_like(6), jointed_box,
                  triangles_with({{{0.0, 1.0}, {1.0, 1.0}}, {{0.5, 0.5}, {0.5, 0.99}}, {{0.4, 1.5}, {0.992, 1.5}}}));
    EXPECT_EQ(mesh.report.ends_moved, 2);
    EXPECT_TRUE(agrees("furthest", mesh.report.largest_move, 0.01, 1e-9));
    EXPECT_TRUE(agrees("length", mesh.report.trace_length, 1.0 + 0.5 + 0.6, 1e-12));
}

TEST(JointedDelaunay, SameInputSameBytes) {
    const Lines traces{{{0.0, 0.3}, {1.0, 0.8}}, {{0.3, 0.0}, {0.6, 2.0}}, {{0.1, 1.2}, {0.9, 1.25}}};
    const auto centres = packing_like(7);
    const Mesh once = make_mesh(centres, jointed_box, triangles_with(traces)),
               again = make_mesh(centres, jointed_box, triangles_with(traces));
    EXPECT_EQ(once.corners, again.corners);
    EXPECT_EQ(once.edge_traces, again.edge_traces);
}

TEST(JointedDelaunay, RandomNetworksAreMeshedOrRefusedByName) {
#ifdef __SANITIZE_ADDRESS__
    constexpr int networks = 300;  // with sanitizers, each takes several times as long
#else
    constexpr int networks = 1000;
#endif
    const testing::NetworkCount count = testing::mesh_random_networks(MeshKind::delaunay, networks);
    EXPECT_GT(count.meshed, networks / 2);
    EXPECT_GT(count.refused, networks / 50);
}

TEST(JointedDelaunay, CoincidentCentresAreNamedAsTheyAreGiven) {
    auto centres = packing_like(8);
    const auto last = static_cast<int>(centres.size());
    centres.push_back(centres[790]);  // far from the trace; centres near the trace are omitted, which changes indices
    try {
        make_mesh(centres, jointed_box, triangles_with({{{0.0, 0.1}, {0.5, 0.4}}}));
        FAIL() << "meshed";
    } catch (const MeshError& error) {
        const std::string text = error.what();
        fmt::print("  {}\n", text);
        EXPECT_EQ(error.centres, (std::vector<int>{790, last}));
        EXPECT_NE(text.find(fmt::format("found centres 790 and {} at the same place", last)), std::string::npos);
    }
}

TEST(JointedDelaunay, WhatCannotBeMeshedIsRefused) {
    const auto refusal = [](const MeshRequest& request) -> std::string {
        try {
            make_mesh(packing_like(1), jointed_box, request);
        } catch (const MeshError& error) {
            fmt::print("  {}\n", error.what());
            return error.what();
        }
        return "accepted";
    };
    MeshRequest request = triangles_with({{{0.2, 0.2}, {0.8, 0.8}}});
    request.boundary = Boundary::centres;
    EXPECT_NE(refusal(request).find("found 1 traces together with triangles that end at the outermost centres"),
              std::string::npos);
    EXPECT_NE(refusal(triangles_with({{{0.2, 0.2}, {1.8, 0.8}}})).find("found trace 0 with a point at (1.8, 0.8)"),
              std::string::npos);
    EXPECT_NE(refusal(triangles_with({{{0.2, 0.2}, {0.2, 0.2}}})).find("found trace 0 with a point at"),
              std::string::npos);
    EXPECT_NE(refusal(triangles_with({{{0.1, 0.2}, {0.8, 0.2}}, {{0.1, 0.2005}, {0.8, 0.2005}}}))
                  .find("found trace 0 and trace 1 0.0005 apart"),
              std::string::npos);
    EXPECT_NE(refusal(triangles_with({{{0.1, 0.5}, {0.13, 0.5}}, {{0.1, 0.5}, {0.13, 0.5003}}}))
                  .find("meeting at less than a degree"),
              std::string::npos);
    EXPECT_NE(refusal(triangles_with({{{0.1, 0.0005}, {0.9, 0.0005}}})).find("and a wall"), std::string::npos);
}

}  // namespace
}  // namespace crackle
