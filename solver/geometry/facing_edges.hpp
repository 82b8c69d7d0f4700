// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of polygons before the mesh was inset, and the lengths over which edges of two bodies face each other.
// Tested by tests/solver/geometry/contact_share_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Corners of a body at its current position, m, in the order of its elements.
inline std::vector<Vec2> corners_of(const World& world, BodyIndex b) {
    const BodyInfo info = world.bodies.info(b);
    const BodyState& state = world.bodies.state[b];
    std::vector<Vec2> corners;
    corners.reserve(info.element_count);
    const BodyView bodies(world);
    for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e)
        corners.push_back(Vec2{state.x, state.y} + turned(state, element_of(bodies, b, e)));
    return corners;
}

/// An edge of an outline after all edges of the outline have been shifted outwards by the same distance.
struct OutsetEdge {
    Vec2 start, along;  // m, start; unit vector from the start to the end
    double length;      // m

    /// Unit normal that points out of the body.
    Vec2 outwards() const { return {along.y, -along.x}; }
};

/// The vector divided by its length, which must not be 0.
inline Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }

/// Tangent of half the angle from direction a to direction b.
inline double half_turn(Vec2 a, Vec2 b) {
    const double sine = a.x * b.y - a.y * b.x, cosine = dot(a, b);
    return sine / (1.0 + cosine);
}

/// Edges of an outline, each shifted outwards. @param corners counter-clockwise, m @param by distance of the shift, m
inline std::vector<OutsetEdge> outset_edges(const std::vector<Vec2>& corners, double by) {
    const std::size_t n = corners.size();
    const auto direction = [&](std::size_t k) { return unit(corners[(k + 1) % n] - corners[k % n]); };
    std::vector<OutsetEdge> edges;
    edges.reserve(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 along = direction(k);
        const double before = by * half_turn(direction(k + n - 1), along),
                     beyond = by * half_turn(along, direction(k + 1));
        const Vec2 outwards{along.y, -along.x};
        edges.push_back({corners[k] + by * outwards - before * along, along,
                         norm(corners[(k + 1) % n] - corners[k]) + before + beyond});
    }
    return edges;
}

/// Part of an edge that faces another edge: distances from the edge's start, m; empty if `to` is at most `from`.
struct FacingPart {
    double from = 0.0, to = 0.0;
};

/// Two edges face each other if the cosine of the angle between their directions is at most -least_facing. Facing edges
/// of a mesh are parallel.
inline constexpr double least_facing = 0.9;

/// Part of edge a that edge b faces. @param reach largest allowed distance between them, m
inline FacingPart facing_part(const OutsetEdge& a, const OutsetEdge& b, double reach) {
    if (dot(a.along, b.along) > -least_facing) return {};
    const Vec2 end = b.start + b.length * b.along;
    const double from = dot(end - a.start, a.along), to = dot(b.start - a.start, a.along);
    const double apart = dot(0.5 * (b.start + end) - a.start, a.outwards());
    if (std::abs(apart) > reach) return {};
    return {std::max(0.0, from), std::min(a.length, to)};
}

}  // namespace crackle
