// SPDX-License-Identifier: GPL-3.0-or-later
// Looking at the world: one contact point with all its numbers, forces on walls, positions in the input's terms. For
// outputs, solves and checks, never for the step.
// Tested by tests/solver/contact/law_test.cpp.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Everything about one contact point at the present positions.
struct PointView {
    PointKind kind;
    BodyIndex body_i, body_j;
    double overlap;       // δ, m
    Vec2 normal;          // unit, from i to j
    Vec2 position;        // m, midway between the two surfaces
    Vec2 arm_i, arm_j;    // m, from the centroids to the position (arm_j zero for walls)
    double normal_force;  // elastic: k_n(δ - δ0), N, compression positive (0 when not touching)
    double shear_force;   // elastic, N on i along the normal turned by +90 degrees
    double normal_stiffness, shear_stiffness, friction;
    double bond_overlap;
    /// Of δ by the motions of i (x, y in m, rotation in rad) and of j. Under the rounded law (n, arm × n) and its
    /// opposite, the directions in which the force works; under the guide's it differs from them.
    std::array<double, 6> overlap_gradient;
    bool bonded, touching, sliding, slid;
    bool sticks;        // its shear spring can act
    bool closed_joint;  // of an open joint whose faces touch from the start
};

PointView view_point(const World& world, PointIndex point);
/// contact_geometry() of any point, whatever its kind.
ContactGeometry geometry_at(const World& world, PointIndex point);
/// Only the overlap of it, m.
double overlap_of(const World& world, PointIndex point);
/// First and behind the last of the points between the bodies of a point that is not with a wall: they lie together.
std::pair<PointIndex, PointIndex> points_between(const World& world, PointIndex point);
/// Number of the internal index of an input id; throws InputError if there is none.
BodyIndex body_of_id(const World& world, int id);
/// World-frame corners of a chain body, or circle centres of a circle body, in input order.
std::vector<Vec2> element_positions(const World& world, BodyIndex body);
/// Force of the bodies on each wall at the last force pass, N. @throws std::logic_error where they are not kept
std::array<Vec2, 4> measure_wall_forces(const World& world);
/// Saves time and memory where the forces of single points, and those on walls, are never read.
void forget_point_forces(World& world);

}  // namespace crackle
