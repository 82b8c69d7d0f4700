// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/geometry/across_joint.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "solver/geometry/contact_share.hpp"

namespace crackle {
namespace {

/// For each edge of a body's outline: the side of a trace on which it lies. Empty for a body without an outline.
std::span<const TraceSide> sides_of(const World& world, BodyIndex b) {
    const BodyInfo info = world.bodies.info(b);
    if (world.bodies.element_sides.empty() || info.piece_count == 0) return {};
    return std::span(world.bodies.element_sides).subspan(info.first_element, info.element_count);
}

bool on_trace(std::span<const TraceSide> sides) {
    return std::ranges::any_of(sides, [](TraceSide side) { return side != no_side; });
}

std::int32_t joint_of_trace(const World& world, std::int32_t trace) {
    return world.settings.trace_joints[static_cast<std::size_t>(trace)];
}

/// Trace of the first straight part (piece) along which the two circles have flat faces on opposite sides.
std::optional<std::int32_t> trace_between_circles(const World& world, BodyIndex i, BodyIndex j) {
    for (const FlatFace& own : world.bodies.flat_faces_of(i))
        for (const FlatFace& other : world.bodies.flat_faces_of(j))
            if (own.piece == other.piece && own.side != other.side) return trace_of(own.side);
    return std::nullopt;
}

}  // namespace

std::optional<std::int32_t> trace_between(const World& world, BodyIndex i, BodyIndex j) {
    if (!world.bodies.flat_faces.empty()) return trace_between_circles(world, i, j);
    std::optional<std::int32_t> first;
    const std::span<const TraceSide> own = sides_of(world, i);
    if (!on_trace(own)) return first;
    const std::span<const TraceSide> others = sides_of(world, j);
    for (const TraceSide side : own) {
        if (side == no_side || std::ranges::find(others, across(side)) == others.end()) continue;
        first = std::min(first.value_or(std::numeric_limits<std::int32_t>::max()), trace_of(side));
    }
    return first;
}

std::int32_t joint_between(const World& world, BodyIndex i, BodyIndex j) {
    const std::optional<std::int32_t> trace = trace_between(world, i, j);
    return trace ? joint_of_trace(world, *trace) : no_joint;
}

std::optional<std::int32_t> trace_of_face(const World& world, BodyIndex i, BodyIndex j, double gap) {
    if (!on_trace(sides_of(world, i)) && !on_trace(sides_of(world, j))) return std::nullopt;
    if (const std::optional<std::int32_t> trace = trace_between(world, i, j)) return trace;
    const BodyInfo a = world.bodies.info(i), b = world.bodies.info(j);
    if (a.piece_count == 0 || b.piece_count == 0) return std::nullopt;
    const std::optional<ContactShare> face = share_of_face(world, i, j, gap);
    if (!face) return std::nullopt;
    const TraceSide side = std::max(sides_of(world, i)[face->edge_i], sides_of(world, j)[face->edge_j]);
    return side == no_side ? std::nullopt : std::optional(trace_of(side));
}

std::int32_t joint_of_face(const World& world, BodyIndex i, BodyIndex j, double gap) {
    const std::optional<std::int32_t> trace = trace_of_face(world, i, j, gap);
    return trace ? joint_of_trace(world, *trace) : no_joint;
}

std::int32_t joint_of_flat_faces(const World& world, const ContactPoint& point) {
    return joint_of_trace(world, trace_of(world.bodies.flat_faces[point.element_i].side));
}

double rest_overlap_between(const World& world, BodyIndex i, BodyIndex j) {
    const std::int32_t joint = joint_between(world, i, j);
    return joint == no_joint ? 0.0 : world.settings.joints[static_cast<std::size_t>(joint)].aperture;
}

}  // namespace crackle
