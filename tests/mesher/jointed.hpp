// SPDX-License-Identifier: GPL-3.0-or-later
// Makes meshes with traces, and measures their edges on traces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesher/trace_graph.hpp"
#include "tests/mesher/centres.hpp"

namespace crackle::testing {

using Lines = std::vector<std::vector<Point>>;

inline MeshRequest with_traces(MeshKind kind, Lines traces, double gap = 0.0) {
    MeshRequest request;
    request.kind = kind;
    request.traces = std::move(traces);
    request.mesh_gap = gap;
    return request;
}

inline double distance_from_line(Point a, Point b, Point p) {
    return std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / distance(a, b);
}

/// Properties of the edges on traces, for a mesh without inset.
struct TraceCheck {
    std::map<int, double> length;   // length of edges by trace, each edge counted once
    double off_line = 0.0;          // largest distance of a corner from its trace
    bool paired = true;             // whether each edge occurs once on either side
    double between_sides = 0.0;     // largest difference of the lengths on either side of a trace
    double smallest_angle = 180.0;  // degrees, of cells with a corner on a trace
};

inline TraceCheck check(const Mesh& mesh, const Lines& traces) {
    TraceCheck result;
    std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> seen;
    std::map<int, double> difference;
    std::set<std::pair<double, double>> on_trace;
    for (const Cell& cell : mesh.cells) {
        const auto corners = mesh.outline(cell);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int trace = mesh.edge_traces[cell.first_corner + k];
            if (trace < 0) continue;
            const Point a = corners[k], b = corners[(k + 1) % corners.size()];
            const auto& line = traces[static_cast<std::size_t>(trace)];
            double off = 1e300;  // distance from the nearest straight part
            for (std::size_t part = 0; part + 1 < line.size(); ++part)
                off = std::min(off, std::max(distance_from_line(line[part], line[part + 1], a),
                                             distance_from_line(line[part], line[part + 1], b)));
            result.off_line = std::max(result.off_line, off);
            result.length[trace] += 0.5 * distance(a, b);
            const Point along{line.back().x - line.front().x, line.back().y - line.front().y};
            difference[trace] += (b.x - a.x) * along.x + (b.y - a.y) * along.y > 0.0 ? distance(a, b) : -distance(a, b);
            seen[std::minmax(std::pair{a.x, a.y}, std::pair{b.x, b.y})] += 1;
            on_trace.insert({a.x, a.y});
            on_trace.insert({b.x, b.y});
        }
    }
    for (const auto& [edge, count] : seen) result.paired = result.paired && count == 2;
    for (const auto& [trace, length] : difference)
        result.between_sides = std::max(result.between_sides, std::abs(length));
    for (const Cell& cell : mesh.cells) {
        const auto c = mesh.outline(cell);
        if (std::none_of(c.begin(), c.end(), [&](Point p) { return on_trace.contains({p.x, p.y}); })) continue;
        for (std::size_t k = 0; k < c.size(); ++k) {
            const Point a = c[k], u{c[(k + 1) % c.size()].x - a.x, c[(k + 1) % c.size()].y - a.y},
                        v{c[(k + c.size() - 1) % c.size()].x - a.x, c[(k + c.size() - 1) % c.size()].y - a.y};
            result.smallest_angle = std::min(
                result.smallest_angle, std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y) * 57.29577951308232);
        }
    }
    return result;
}

inline double length_of(const std::vector<Point>& line) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += distance(line[k], line[k + 1]);
    return sum;
}

inline const Rectangle jointed_box{0.0, 1.0, 0.0, 2.0};

inline std::vector<CellCentre> packing_like(std::uint64_t seed, int across = 20) {
    return testing::lattice(across, 2 * across, jointed_box, 0.4, seed);
}

struct NetworkCount {
    int meshed = 0, refused = 0, cut = 0;
};

/// Random networks with few or many traces, some with small angles, traces a thousandth of a cell apart, ends on walls,
/// or coincident traces. Each must give a valid mesh or an error that names traces.
inline NetworkCount mesh_random_networks(MeshKind kind, std::uint64_t networks) {
    NetworkCount result;
    for (std::uint64_t seed = 1; seed <= networks; ++seed) {
        std::mt19937_64 generator(seed);
        const auto number = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
        const int across = seed % 10 == 0 ? 12 : 8;
        const auto centres = lattice(across, 2 * across, jointed_box, 0.4, seed);
        Lines traces;
        const int count = seed % 50 == 0 ? 500 : 1 + static_cast<int>(seed % 7);
        for (int k = 0; k < count; ++k) {
            const Point a{number(), 2.0 * number()}, b{number(), 2.0 * number()};
            traces.push_back({a, b});
            if (seed % 5 == 1 && k == 0)
                traces.push_back({{a.x, a.y}, {b.x, std::min(2.0, b.y + 0.02)}});  // a small angle
            if (seed % 5 == 2 && k == 0)
                traces.push_back({{a.x, std::min(2.0, a.y + 1e-4)}, {b.x, std::min(2.0, b.y + 1e-4)}});
            if (seed % 5 == 3 && k == 0) traces.push_back({{0.0, a.y}, b});  // an end on the wall
            if (seed % 5 == 4 && k == 0) traces.push_back({{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, b});  // coincident
        }
        try {
            const Mesh mesh = make_mesh(centres, jointed_box, with_traces(kind, traces));
            ++result.meshed;
            EXPECT_NEAR(sum_of_areas(mesh), 2.0, 2e-12) << seed;
            EXPECT_TRUE(convex_and_counter_clockwise(mesh, 2.0)) << seed;
            const TraceGraph graph = trace_graph(
                jointed_box, traces, trace_reach_share * std::sqrt(2.0 / static_cast<double>(centres.size())));
            double expected = 0.0;
            for (const auto& edge : graph.edges)
                if (edge.trace >= 0)
                    expected += distance(graph.nodes[static_cast<std::size_t>(edge.from)],
                                         graph.nodes[static_cast<std::size_t>(edge.to)]);
            // If cells were cut, trace ends may have moved.
            const double moved = mesh.report.cells_cut == 0
                                     ? 0.0
                                     : static_cast<double>(mesh.report.ends_moved) * mesh.report.largest_move;
            EXPECT_NEAR(mesh.report.trace_length, expected, 1e-9 * expected + moved) << seed;
            const TraceCheck found = check(mesh, traces);
            EXPECT_LE(found.off_line, 2e-12) << seed;
            if (mesh.report.cells_cut == 0) {
                EXPECT_TRUE(found.paired) << seed;
            } else {
                ++result.cut;
                EXPECT_LE(found.between_sides, 1e-9) << seed;
            }
        } catch (const MeshError& error) {
            ++result.refused;
            EXPECT_FALSE(error.traces.empty()) << seed << ' ' << error.what();
            EXPECT_NE(std::string(error.what()).find("trace"), std::string::npos) << error.what();
        }
    }
    fmt::print("  {} networks meshed, {} of them with cells cut, {} refused\n", result.meshed, result.cut,
               result.refused);
    return result;
}

}  // namespace crackle::testing
