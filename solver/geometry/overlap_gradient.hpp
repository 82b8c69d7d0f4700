// SPDX-License-Identifier: GPL-3.0-or-later
// Derivative of a contact point's overlap with respect to small motions of its two bodies, for linear solves and the
// stable time step.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <array>

#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Derivative of the overlap δ with respect to the motions of bodies i and j (x and y in m, rotation in rad for each).
using OverlapGradient = std::array<double, 6>;

/// Rate at which the two contact positions approach along `direction`, per unit motion of the bodies: (d, arm_i × d,
/// -d, -arm_j × d).
inline OverlapGradient closing_gradient(Vec2 direction, Vec2 arm_i, Vec2 arm_j) {
    return {direction.x, direction.y, cross(arm_i, direction), -direction.x, -direction.y, -cross(arm_j, direction)};
}

/// Exact derivative of the overlap under the DEMseg guide's segment law at the current positions. Without contact,
/// returns the derivative of the negative distance to the nearest disc.
/// @param kind disc_segment or segment_segment
OverlapGradient guide_gradient(const World& world, PointKind kind, const ContactPoint& point);

/// Overlap gradients of the discs of a point that are not in contact at present, but may come into contact before the
/// neighbour list is rebuilt.
std::vector<OverlapGradient> idle_discs(const World& world, PointKind kind, const ContactPoint& point);

}  // namespace crackle
