// SPDX-License-Identifier: GPL-3.0-or-later
// Values read from a world: all values of one contact point, forces on walls, positions of elements in input order. For
// outputs, linear solves and checks; not used in a step.
// Tested by tests/solver/laws/law_test.cpp.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// All values of one contact point at the current positions.
struct PointView {
    PointKind kind;
    BodyIndex body_i, body_j;
    double overlap;       // δ, m
    Vec2 normal;          // unit vector from i to j
    Vec2 position;        // m, midway between the two surfaces
    Vec2 arm_i, arm_j;    // vectors from the centroids to `position`, m; arm_j is zero for walls
    double normal_force;  // N, elastic force k_n(δ - δ0), compression positive (0 without contact)
    double shear_force;   // N, elastic force on i along the normal turned by +90 degrees
    double normal_stiffness, shear_stiffness, friction;
    double bond_overlap;
    /// Gradient of δ with respect to the motions of bodies i and j (x and y in m, rotation in rad for each). Under the
    /// rounded law it is (n, arm_i × n, -n, -arm_j × n), parallel to the generalized force. Under the DEMseg guide's
    /// segment law it has another direction.
    std::array<double, 6> overlap_gradient;
    bool bonded, touching, sliding, slid;
    bool sticks;  // whether the shear spring can carry force without sliding
    /// Whether the point lies in an open joint whose faces touch from the start, so that linear solutions treat it as
    /// bonded.
    bool closed_joint;
};

/// Values of one contact point at the current positions; the shear spring and the flags are those of the last force
/// pass.
PointView view_point(const World& world, PointIndex point);
/// Returns contact_geometry() of a point of any kind.
ContactGeometry geometry_at(const World& world, PointIndex point);
/// Overlap of a point of any kind, m.
double overlap_of(const World& world, PointIndex point);
/// Range [first, end) of the points between the same two bodies, which are stored contiguously. @param point index of a
/// point that is not at a wall
std::pair<PointIndex, PointIndex> points_between(const World& world, PointIndex point);
/// Internal index of the body with the given input id. @throws InputError if no body has it
BodyIndex body_of_id(const World& world, int id);
/// World coordinates of the corners of a chain body, or of the circle centres of a circle body, in input order, m.
std::vector<Vec2> element_positions(const World& world, BodyIndex body);
/// Force of the bodies on each wall in the last force pass, N. @throws std::logic_error if point forces are not stored
std::array<Vec2, 4> measure_wall_forces(const World& world);
/// Stops storing the forces of points, and thus of walls. This saves time and memory if the forces are never read.
void forget_point_forces(World& world);

}  // namespace crackle
