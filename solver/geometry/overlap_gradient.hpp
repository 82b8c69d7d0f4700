// SPDX-License-Identifier: GPL-3.0-or-later
// How the overlap of a point answers to small motions of its two bodies, for linear solves and the stable step.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <array>

#include "solver/geometry/geometry.hpp"

namespace crackle {

/// By the motions of i (x, y in m, rotation in rad) and of j.
using OverlapGradient = std::array<double, 6>;

/// How fast the two bodies' materials close in along `direction`: (d, arm_i × d, -d, -arm_j × d).
inline OverlapGradient closing_gradient(Vec2 direction, Vec2 arm_i, Vec2 arm_j) {
    return {direction.x, direction.y, cross(arm_i, direction), -direction.x, -direction.y, -cross(arm_j, direction)};
}

/// Exact derivative of δ under the guide's law at the present positions; out of contact that of the nearest disc's
/// distance.
/// @param kind disc_segment or segment_segment
OverlapGradient guide_gradient(const World& world, PointKind kind, const ContactPoint& point);

/// Discs of a point under the guide's law that are not in contact but could be before the list is rebuilt, each as the
/// spring it would be.
std::vector<OverlapGradient> idle_discs(const World& world, PointKind kind, const ContactPoint& point);

}  // namespace crackle
