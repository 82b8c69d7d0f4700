// SPDX-License-Identifier: GPL-3.0-or-later
// Tests traces as a graph: nodes lie on the lines of their traces, lengths are preserved, ends are extended to nearby
// traces, and coincident parts become one.

#include "mesher/trace_graph.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;
using Lines = std::vector<std::vector<Point>>;

const Rectangle unit_box{0.0, 1.0, 0.0, 1.0};

double length_of(const TraceGraph& graph, int trace) {
    double sum = 0.0;
    for (const auto& edge : graph.edges)
        if (edge.trace == trace)
            sum += distance(graph.nodes[static_cast<std::size_t>(edge.from)],
                            graph.nodes[static_cast<std::size_t>(edge.to)]);
    return sum;
}
double sum_of(const std::vector<double>& areas) { return std::accumulate(areas.begin(), areas.end(), 0.0); }

TEST(TraceGraph, ACrossHasFiveNodesBesideTheCorners) {
    const TraceGraph graph = trace_graph(unit_box, Lines{{{0.0, 0.3}, {1.0, 0.3}}, {{0.4, 0.0}, {0.4, 1.0}}}, 0.0);
    EXPECT_EQ(graph.nodes.size(), 9U);
    EXPECT_EQ(graph.edges.size(), 12U);
    std::vector<double> areas = parted_areas(graph);
    std::sort(areas.begin(), areas.end());
    ASSERT_EQ(areas.size(), 4U);
    EXPECT_TRUE(agrees("smallest", areas[0], 0.12, 1e-14));
    EXPECT_TRUE(agrees("largest", areas[3], 0.42, 1e-14));
}

TEST(TraceGraph, NodesOfRandomTracesLieOnTheirLinesAndKeepTheirLength) {
    std::mt19937_64 generator(7);
    const auto number = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
    const Rectangle box{100.0, 101.0, -50.0, -48.0};
    Lines traces;
    for (int k = 0; k < 300; ++k)
        traces.push_back({{100.0 + number(), -50.0 + 2.0 * number()}, {100.0 + number(), -50.0 + 2.0 * number()}});
    const TraceGraph graph = trace_graph(box, traces, 0.0);
    double furthest = 0.0;
    for (const auto& edge : graph.edges) {
        if (edge.trace < 0) continue;
        const Point a = traces[static_cast<std::size_t>(edge.trace)][0],
                    b = traces[static_cast<std::size_t>(edge.trace)][1];
        for (const int n : {edge.from, edge.to}) {
            const Point p = graph.nodes[static_cast<std::size_t>(n)];
            furthest =
                std::max(furthest, std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / distance(a, b));
        }
    }
    EXPECT_TRUE(within("distance of nodes from their lines", furthest, 0.0, 1e-12));
    for (int k = 0; k < 300; ++k)
        EXPECT_NEAR(length_of(graph, k),
                    distance(traces[static_cast<std::size_t>(k)][0], traces[static_cast<std::size_t>(k)][1]), 1e-11);
    EXPECT_TRUE(agrees("areas", sum_of(parted_areas(graph)), 2.0, 1e-12));
    EXPECT_TRUE(graph.coincident.empty());
    EXPECT_TRUE(graph.moved.empty());
}

TEST(TraceGraph, EndsReachWhatIsNearAlongTheirOwnLine) {
    // One trace ends shortly before another, one shortly after it, one shortly before a wall, and one too far away.
    const Lines traces{{{0.0, 0.5}, {1.0, 0.5}},
                       {{0.2, 0.1}, {0.2, 0.495}},
                       {{0.3, 0.1}, {0.305, 0.502}},
                       {{0.5, 0.9}, {0.994, 0.9}},
                       {{0.7, 0.1}, {0.7, 0.4}}};
    const TraceGraph graph = trace_graph(unit_box, traces, 0.01);
    ASSERT_EQ(graph.moved.size(), 3U);
    EXPECT_EQ(graph.moved[0].trace, 1);
    EXPECT_EQ(graph.moved[0].onto, 0);
    EXPECT_TRUE(agrees("longer", graph.moved[0].by, 0.005, 1e-9));
    EXPECT_TRUE(within("on the other", graph.moved[0].place.y, 0.5, 0.0));
    EXPECT_EQ(graph.moved[1].trace, 2);
    EXPECT_LT(graph.moved[1].by, 0.0);
    EXPECT_TRUE(within("on its own line",
                       (graph.moved[1].place.x - 0.3) * 0.402 - 0.005 * (graph.moved[1].place.y - 0.1), 0.0, 1e-15));
    EXPECT_EQ(graph.moved[2].onto, -1);
    EXPECT_EQ(graph.moved[2].place.x, 1.0);
    EXPECT_TRUE(agrees("length of the fourth", length_of(graph, 3), 0.5, 1e-14));
    EXPECT_TRUE(agrees("length of the fifth", length_of(graph, 4), 0.3, 1e-14));
}

TEST(TraceGraph, CoincidentTracesAreOne) {
    const TraceGraph graph =
        trace_graph(unit_box, Lines{{{0.1, 0.1}, {0.9, 0.5}}, {{0.5, 0.3}, {0.9, 0.5}}, {{0.0, 0.0}, {1.0, 0.0}}}, 0.0);
    ASSERT_EQ(graph.coincident.size(), 2U);
    EXPECT_EQ(graph.coincident[0].first, -1);
    EXPECT_EQ(graph.coincident[0].second, 2);
    EXPECT_EQ(graph.coincident[1].first, 0);
    EXPECT_EQ(graph.coincident[1].second, 1);
    EXPECT_TRUE(agrees("length", graph.coincident[1].length, std::hypot(0.4, 0.2), 1e-12));
    EXPECT_TRUE(agrees("length of the first", length_of(graph, 0), std::hypot(0.8, 0.4), 1e-12));
    EXPECT_EQ(length_of(graph, 1), 0.0);
}

// The bounding boxes of all traces overlap, but no trace meets another.
TEST(TraceGraph, ManyParallelTracesMeetTheWallsAlone) {
    constexpr int count = 20'000;
    Lines traces;
    for (int k = 1; k <= count; ++k) {
        const double offset = 2.0 * k / (count + 1) - 1.0;
        traces.push_back({{std::max(0.0, -offset), std::max(0.0, offset)},
                          {std::min(1.0, 1.0 - offset), std::min(1.0, 1.0 + offset)}});
    }
    const TraceGraph graph = trace_graph(unit_box, traces, 1e-5);
    EXPECT_EQ(graph.nodes.size(), 2U * count + 4U);
    EXPECT_EQ(parted_areas(graph).size(), count + 1U);
}

TEST(TraceGraph, MoreCrossingsThanMemoryIsMeantForAreRefused) {
    Lines traces;
    for (int k = 0; k < 2300; ++k) {
        const double at = (k + 0.5) / 2300;
        traces.push_back({{0.0, at}, {1.0, at}});
        traces.push_back({{at, 0.0}, {at, 1.0}});
    }
    try {
        trace_graph(unit_box, traces, 0.0);
        ADD_FAILURE() << "accepted";
    } catch (const MeshError& error) {
        EXPECT_NE(std::string(error.what()).find("found more than 5000000 places where traces meet"), std::string::npos)
            << error.what();
    }
}

TEST(TraceGraph, ThreeTracesThroughAPointHaveOneNodeThere) {
    Lines traces;
    for (const double angle : {0.3, 1.1, 2.0})
        traces.push_back({{0.5 - 0.4 * std::cos(angle), 0.5 - 0.4 * std::sin(angle)},
                          {0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle)}});
    EXPECT_EQ(trace_graph(unit_box, traces, 0.0).nodes.size(), 4U + 6U + 1U);
}

}  // namespace
}  // namespace crackle
