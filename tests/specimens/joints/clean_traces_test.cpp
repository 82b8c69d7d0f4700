// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that nearly coincident nodes of a survey are merged. Nothing may move farther than snap, other points must stay
// identical, and no gap smaller than a grain may remain for the mesher.

#include "specimens/joints/clean_traces.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "mesher/trace_graph.hpp"
#include "specimens/joints/mesh_traces.hpp"
#include "tests/specimens/joints/cases.hpp"
#include "tests/support/claim.hpp"

namespace crackle::clean_traces_test {
namespace {

using testing::box;
using testing::joints_of;

using Lines = std::vector<std::vector<Vec2>>;

std::vector<JointTrace> traces_of(const Lines& lines) {
    std::vector<JointTrace> traces;
    for (const auto& points : lines) traces.push_back({points, 0, 0.0, true});
    return traces;
}

double distance_from(const std::vector<JointTrace>& traces, Vec2 p) {
    double least = std::numeric_limits<double>::infinity();
    for (const JointTrace& trace : traces) {
        for (std::size_t k = 0; k + 1 < trace.points.size(); ++k) {
            const Vec2 a = trace.points[k], d = trace.points[k + 1] - a;
            const double share = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
            least = std::min(least, norm(a + share * d - p));
        }
    }
    return least;
}
double distance_from_walls(const Domain& domain, Vec2 p) {
    return std::min(
        {std::abs(p.x - domain.x1), std::abs(p.x - domain.x2), std::abs(p.y - domain.y1), std::abs(p.y - domain.y2)});
}

/// Largest distance of positions along the first traces from the second traces, or from the walls if given.
double farthest(const std::vector<JointTrace>& of, const std::vector<JointTrace>& from, const Domain* walls) {
    double largest = 0.0;
    for (const JointTrace& trace : of) {
        for (std::size_t k = 0; k + 1 < trace.points.size(); ++k) {
            for (int part = 0; part <= 20; ++part) {
                const Vec2 p = trace.points[k] + part / 20.0 * (trace.points[k + 1] - trace.points[k]);
                const double off = distance_from(from, p);
                largest = std::max(largest, walls == nullptr ? off : std::min(off, distance_from_walls(*walls, p)));
            }
        }
    }
    return largest;
}

/// The smallest distance of a node from an edge that does not end at it, or from another node.
double narrowest_gap(const std::vector<JointTrace>& traces, const Domain& domain) {
    std::vector<std::vector<Point>> lines;
    for (const JointTrace& trace : traces) {
        auto& line = lines.emplace_back();
        for (const Vec2 p : trace.points) line.push_back({p.x, p.y});
    }
    const TraceGraph graph = trace_graph({domain.x1, domain.x2, domain.y1, domain.y2}, lines, 0.0);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const auto& edge : graph.edges)
            if (static_cast<std::size_t>(edge.from) != n && static_cast<std::size_t>(edge.to) != n)
                least = std::min(least, distance_to({graph.nodes[static_cast<std::size_t>(edge.from)],
                                                     graph.nodes[static_cast<std::size_t>(edge.to)]},
                                                    graph.nodes[n]));
    return least;
}

/// Traces in a box of 1 m by 1 m with nearly coincident nodes: distances are 1e-9 to 1e-1 of a grain of 0.05 m.
Lines window(std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    const auto number = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
    const auto in_box = [](Vec2 p) { return Vec2{std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0)}; };
    const auto near = [&](Vec2 p) {
        const double off = 0.05 * std::pow(10.0, -9.0 + 8.0 * number()), angle = 6.28 * number();
        return in_box({p.x + off * std::cos(angle), p.y + off * std::sin(angle)});
    };
    const auto place = [&] { return Vec2{number(), number()}; };
    Lines lines{{place(), place(), place()}, {place(), place()}};
    for (int k = 0; k < 8; ++k) {
        const auto& other = lines[generator() % lines.size()];
        const std::size_t part = generator() % (other.size() - 1);
        const Vec2 at = other[part] + number() * (other[part + 1] - other[part]);
        switch (generator() % 5) {
            case 0:
                lines.push_back({place(), near(at)});
                break;
            case 1:
                lines.push_back({place(), near(at), place()});
                break;
            case 2:
                lines.push_back({near(other.front()), near(other.back())});
                break;
            case 3:
                lines.push_back({near(at), near(at), place(), near(at)});
                break;
            default: {
                std::vector<Vec2> fine;
                const Vec2 from = place(), to = place();
                for (int n = 0; n <= 200; ++n)
                    fine.push_back(in_box(from + n / 200.0 * (to - from) + Vec2{0.0, 0.03 * std::sin(n / 25.0)}));
                lines.push_back(fine);
            }
        }
    }
    for (auto& line : lines) line.erase(std::unique(line.begin(), line.end()), line.end());
    std::erase_if(lines, [](const auto& line) { return line.size() < 2; });
    return lines;
}

TEST(CleanTraces, NothingMovesFurtherThanSnap) {
    const Domain domain = box(1.0, 1.0);
    double most_moved = 0.0, narrowest = 1.0;
    int narrow = 0;
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        const double snap = seed % 3 == 0 ? 0.02 : 0.005;
        const std::vector<JointTrace> given = traces_of(window(seed));
        std::vector<JointTrace> cleaned = given, again = given;
        const Cleaning report = clean_traces(cleaned, domain, snap, 0.0);
        clean_traces(again, domain, snap, 0.0);
        ASSERT_EQ(cleaned.size(), again.size());
        for (std::size_t k = 0; k < cleaned.size(); ++k) EXPECT_EQ(cleaned[k].points, again[k].points) << seed;
        const double allowed = snap * (1.0 + 1e-9);
        EXPECT_LE(report.largest_displacement, allowed) << seed;
        EXPECT_LE(farthest(cleaned, given, nullptr), allowed) << seed;
        EXPECT_LE(farthest(given, cleaned, &domain), allowed) << seed;
        most_moved = std::max(most_moved, report.largest_displacement / snap);
        const double gap = narrowest_gap(cleaned, domain) / snap;
        narrowest = std::min(narrowest, gap);
        if (gap < 0.2) ++narrow;
    }
    fmt::print("  largest displacement {:.3f} snap, narrowest gap {:.3g} snap; {} windows with one below 0.2\n",
               most_moved, narrowest, narrow);
    EXPECT_GT(most_moved, 0.3) << "in some windows, points must move";
    EXPECT_LE(narrow, 2) << "a fiftieth";
}

// Each node is near the next one, but the first is far from the last.
TEST(CleanTraces, AChainOfNearNodesGoesNoFurtherThanSnap) {
    for (const double step : {0.1, 0.3, 0.45, 0.49, 0.51, 0.7}) {
        Lines lines;
        for (int k = 0; k < 60; ++k) {
            const double x = 0.2 + k * step * 0.01;
            lines.push_back({{x, 0.5}, {x + 0.02 * (k % 2), 0.9}});
        }
        std::vector<JointTrace> cleaned = traces_of(lines);
        const Cleaning report = clean_traces(cleaned, box(1.0, 1.0), 0.01, 0.0);
        EXPECT_LE(report.largest_displacement, 0.01) << step;
        double last = 0.0;
        for (const JointTrace& trace : cleaned)
            for (const Vec2 p : trace.points) last = std::max(last, p.x);
        EXPECT_NEAR(last, 0.2 + 59 * step * 0.01 + 0.02, 0.01) << step;
    }
}

TEST(CleanTraces, WhatIsNotConcernedKeepsItsBytes) {
    const Lines apart{{{0.1, 0.1}, {0.9, 0.7}}, {{0.1, 0.9}, {0.8, 0.1}}, {{0.0, 0.3}, {0.3, 0.35}, {0.35, 1.0}}};
    std::vector<JointTrace> cleaned = traces_of(apart);
    EXPECT_FALSE(clean_traces(cleaned, box(1.0, 1.0), 0.005, 0.0).changed());
    for (std::size_t k = 0; k < apart.size(); ++k) EXPECT_EQ(cleaned[k].points, apart[k]);
    Lines one_more = apart;
    one_more.push_back({{0.5, 0.95}, {0.5, 0.9}, {0.500001, 0.9}, {0.7, 0.95}});
    cleaned = traces_of(one_more);
    EXPECT_TRUE(clean_traces(cleaned, box(1.0, 1.0), 0.005, 0.0).changed());
    for (std::size_t k = 0; k < apart.size(); ++k) EXPECT_EQ(cleaned[k].points, apart[k]);
    EXPECT_EQ(cleaned[3].points, (std::vector<Vec2>{{0.5, 0.95}, {0.5, 0.9}, {0.7, 0.95}}));
    EXPECT_EQ(clean_traces(cleaned, box(1.0, 1.0), 0.0, 0.0).snap, 0.0);
}

TEST(CleanTraces, ANodeOffAnotherTraceIsOnIt) {
    for (const double off : {1e-9, 1e-6, 1e-3}) {
        std::vector<JointTrace> traces =
            traces_of({{{0.1, 0.5}, {0.9, 0.5}}, {{0.5, 0.9}, {0.5, 0.5 + off}, {0.6, 0.1}}});
        const Cleaning report = clean_traces(traces, box(1.0, 1.0), 0.005, 0.0);
        EXPECT_EQ(report.brought_together, 1U);
        EXPECT_TRUE(testing::agrees("largest displacement", report.largest_displacement, off, 1e-6));
        EXPECT_EQ(traces[0].points, (std::vector<Vec2>{{0.1, 0.5}, {0.5, 0.5 + off}, {0.9, 0.5}}));
    }
}

// The second trace has a node 1e-12 m from the first trace; this node counts as unmoved. The third trace crosses both
// near it.
TEST(CleanTraces, ANodeOffAnUnmovedTraceLeavesNoGapWhereAThirdCrosses) {
    const Lines lines{
        {{1.648294312902, 0.666818864450}, {0.372899834964, 0.581710215315}},
        {{0.668239214558, 0.217755988036}, {0.930052507966, 0.618889701490}, {1.073049407279, 0.956702979299}},
        {{1.429141621306741, 0.0}, {0.567422259262, 1.116111204584}}};
    for (const double snap : {0.015, 0.01966, 0.03}) {
        std::vector<JointTrace> traces = traces_of(lines);
        clean_traces(traces, box(2.0, 2.0), snap, 1.25 * snap);
        EXPECT_GE(narrowest_gap(traces, box(2.0, 2.0)), 0.25 * snap) << snap;
    }
}

TEST(CleanTraces, TracesOnEachOtherAreTheFirst) {
    std::vector<JointTrace> traces = traces_of({{{0.1, 0.5}, {0.9, 0.5}}, {{0.0, 0.501}, {0.8, 0.5}, {0.8, 0.9}}});
    const Cleaning report = clean_traces(traces, box(1.0, 1.0), 0.005, 0.0);
    ASSERT_EQ(traces.size(), 3U) << "the first two, and the parts of the second before and after the shared line";
    double length = 0.0;
    for (const JointTrace& trace : traces) length += trace.length();
    EXPECT_TRUE(testing::agrees("coincident", report.coincident, 0.7, 1e-3));
    EXPECT_TRUE(testing::agrees("length", length, report.length, 1e-12));
    EXPECT_TRUE(testing::agrees("length", length, 0.8 + 0.1 + 0.4, 1e-3));
    traces = traces_of({{{0.1, 0.5}, {0.9, 0.5}}, {{0.9, 0.5}, {0.1, 0.5}}, {{0.1, 0.0003}, {0.9, 0.0}}});
    EXPECT_TRUE(testing::agrees("twice, and along a wall", clean_traces(traces, box(1.0, 1.0), 0.005, 0.0).coincident,
                                1.6, 1e-6));
    EXPECT_EQ(traces.size(), 1U);
}

TEST(CleanTraces, TracesAtASmallAngleRunTogetherAndPartWhereCellsHaveRoom) {
    for (const double degrees : {0.1, 0.5, 1.0, 2.0}) {
        const double rise = std::tan(degrees * 0.017453292519943295);
        std::vector<JointTrace> traces =
            traces_of({{{0.0, 0.5}, {1.0, 0.5}}, {{0.0, 0.5 - 0.5 * rise}, {1.0, 0.5 + 0.5 * rise}}});
        const Cleaning report = clean_traces(traces, box(1.0, 1.0), 0.005, 0.0);
        EXPECT_GT(report.coincident, 0.05) << degrees;
        EXPECT_GE(narrowest_gap(traces, box(1.0, 1.0)), 0.2 * 0.005) << degrees;
        EXPECT_EQ(traces[0].points.front(), (Vec2{0.0, 0.5}));
    }
}

TEST(CleanTraces, AFineCurveHasAsManyPointsAsItTakes) {
    std::vector<Vec2> fine;
    for (int k = 0; k <= 2000; ++k) fine.push_back({0.1 + 0.0004 * k, 0.5 + 0.1 * std::sin(k / 300.0)});
    std::vector<JointTrace> traces = traces_of({fine});
    const double before = traces[0].length();
    const Cleaning report = clean_traces(traces, box(1.0, 1.0), 0.005, 0.0);
    ASSERT_EQ(traces.size(), 1U);
    EXPECT_LT(traces[0].points.size(), 30U);
    EXPECT_EQ(report.points_left_out, fine.size() - traces[0].points.size());
    EXPECT_LE(report.largest_displacement, 0.25 * 0.005);
    EXPECT_TRUE(testing::within("length", traces[0].length() / before, 1.0, 5e-3));
}

// Shipped cases are 20 to 100 grains wide; none of their nodes nearly coincide.
TEST(CleanTraces, ShippedCasesKeepTheirTraces) {
    for (const char* name : {"survey", "granite_plane", "granite_slipping", "granite_bridges", "granite_set",
                             "softrock_slipping", "granite_welded", "softrock_welded"}) {
        JointCase test =
            CaseFiles(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/jointed" / (std::string(name) + ".toml"))
                .joints();
        const Domain domain = box(test.width.value_or(0.05), test.height.value_or(0.1));
        for (const std::size_t centres : {800U, 3200U, 20000U}) {
            test.joints.snap = std::nullopt;
            const JointNetwork cleaned = make_joints(test.joints, domain, centres);
            test.joints.snap = 0.0;
            const JointNetwork given = make_joints(test.joints, domain, centres);
            fmt::print("  {} of {}: {}\n", name, centres, cleaning_text(cleaned.cleaning));
            ASSERT_EQ(cleaned.traces.size(), given.traces.size()) << name;
            for (std::size_t k = 0; k < given.traces.size(); ++k)
                EXPECT_EQ(cleaned.traces[k].points, given.traces[k].points) << name;
        }
    }
}

}  // namespace
}  // namespace crackle::clean_traces_test
