// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/joint_faces.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace crackle {
namespace {

/// Squared distance of a point from a straight segment, m2.
double squared_distance(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double share = dot(p - a, along) / dot(along, along);
    const Vec2 nearest = a + (share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share) * along;
    return dot(p - nearest, p - nearest);
}

/// Side of a trace on which the cell of an edge lies. A cell lies to the left of its edges, and therefore to the left
/// of a trace in the same direction. On a bent trace, the segment nearest to the edge's midpoint decides.
TraceSide side_of(const JointTrace& trace, std::int32_t number, Vec2 from, Vec2 to) {
    const Vec2 middle = 0.5 * (from + to);
    double nearest = std::numeric_limits<double>::infinity();
    bool along = true;
    for (std::size_t k = 0; k + 1 < trace.points.size(); ++k) {
        const double apart = squared_distance(middle, trace.points[k], trace.points[k + 1]);
        if (apart >= nearest) continue;
        nearest = apart;
        along = dot(to - from, trace.points[k + 1] - trace.points[k]) > 0.0;
    }
    return 2 * number + (along ? 0 : 1);
}

/// Whether a point is on a wall. Traces that a wall cuts end exactly on the wall.
bool on_rim(const Domain& box, Vec2 p) { return p.x == box.x1 || p.x == box.x2 || p.y == box.y1 || p.y == box.y2; }

/// Assigns the mechanical properties of each trace to its faces.
void set_mechanics(Scene& scene, const JointNetwork& network) {
    std::vector<std::int32_t> of_source;
    for (const JointSource& source : network.sources) {
        of_source.push_back(source.mechanics ? static_cast<std::int32_t>(scene.joints.size()) : -1);
        if (source.mechanics) scene.joints.push_back(*source.mechanics);
    }
    for (const JointTrace& trace : network.traces) scene.trace_joints.push_back(of_source[trace.source]);
}

}  // namespace

void set_joints_of_circles(Scene& scene, const JointNetwork& network) {
    set_mechanics(scene, network);
    for (std::size_t number = 0; number < network.traces.size(); ++number) {
        const std::vector<Vec2>& points = network.traces[number].points;
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
            scene.trace_pieces.push_back({static_cast<std::int32_t>(number), points[k], points[k + 1],
                                          k == 0 && on_rim(network.box, points[k]),
                                          k + 2 == points.size() && on_rim(network.box, points[k + 1])});
    }
}

void set_joints(Scene& scene, const Mesh& mesh, const JointNetwork& network) {
    set_mechanics(scene, network);
    for (const Cell& cell : mesh.cells) {
        const std::span<const Point> outline = mesh.outline(cell);
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const int trace = mesh.edge_traces[cell.first_corner + k];
            const Point from = outline[k], to = outline[k + 1 == outline.size() ? 0 : k + 1];
            scene.edge_sides.push_back(trace < 0 ? no_side
                                                 : side_of(network.traces[static_cast<std::size_t>(trace)], trace,
                                                           {from.x, from.y}, {to.x, to.y}));
        }
    }
}

std::string sources_as_rock(const JointNetwork& network) {
    std::string names;
    for (const JointSource& source : network.sources)
        if (!source.mechanics) names += (names.empty() ? "" : ", ") + source.name;
    return names;
}

}  // namespace crackle
