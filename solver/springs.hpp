// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points of a world as linear springs and dashpots: what the sparse solves are assembled from.
//
// A point stretches along its normal and its tangent by
//     a = d·(u_i - u_j) + (r_i × d) θ_i - (r_j × d) θ_j,      d = n or t, r the arms from the centroids
// linearised about the present positions, and stores ½k a². Contact forces are zero after back-tension bonding, so
// there is no geometric stiffness then.
#pragma once

#include <vector>

#include "solver/world.hpp"

namespace crackle {

inline constexpr BodyIndex no_body = static_cast<BodyIndex>(-1);

/// Displacement and rotation of a body, m and rad; or force and moment on it, N and N m.
struct Motion {
    double x = 0.0, y = 0.0, rotation = 0.0;
};
inline double component(const Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }
inline double& component(Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }

/// One spring with its dashpot; a point has one along its normal and one along its tangent.
struct Spring {
    BodyIndex i, j;         ///< j is no_body for a domain wall
    PointIndex point;       ///< into World::points
    bool shear;             ///< along the tangent
    double stiffness;       // N/m
    double damping;         // N s/m
    double coefficient[6];  ///< da/d(x, y, rotation) of i, then of j
};

/// Which points are taken for closed.
enum class ClosedPoints {
    bonded,    ///< bonded ones; touching ones in a world without bonds. Walls left out.
    touching,  ///< all that carry load now, walls included
    listed,    ///< all that may come to carry load before the neighbour list is rebuilt
};

/// What the bodies' displacements stretch a spring by, m: along the normal the growth of the overlap.
double stretch(const Spring& spring, const std::vector<Motion>& displacement);

/// Springs in the order of the points; those of no stiffness and no damping are left out.
std::vector<Spring> springs_of(const World& world, ClosedPoints which);

}  // namespace crackle
