// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points of a world as linear springs and dashpots: what the sparse solves are assembled from.
//
// A point stretches along its normal and its tangent by
//     a = d·(u_i - u_j) + (r_i × d) θ_i - (r_j × d) θ_j,      d = n or t, r the arms from the centroids
// linearised about the present positions, and stores ½k a². Contact forces are zero after back-tension bonding, so
// there is no geometric stiffness then. Under the guide's law a normal spring pushes so too, but its overlap answers to
// g·u (PointView::overlap_gradient): its stiffness is k a gᵀ, unsymmetric.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <vector>

#include "solver/geometry/overlap_gradient.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Displacement and rotation of a body, m and rad; or force and moment on it, N and N m.
struct BodyMotion {
    double x = 0.0, y = 0.0, rotation = 0.0;
};
inline double component(const BodyMotion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }
inline double& component(BodyMotion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }

/// One spring with its dashpot; a point has one along its normal and one along its tangent.
struct Spring {
    BodyIndex i, j;            ///< j is no_body for a domain wall
    PointIndex point;          ///< into Points::contact
    bool shear;                ///< along the tangent
    double stiffness;          // N/m
    double damping;            // N s/m
    OverlapGradient push;      ///< direction it works in: (x, y, rotation) of i, then of j
    OverlapGradient gradient;  ///< da/du; the same but for normal springs under the guide's law

    bool symmetric() const { return push == gradient; }
};

/// Which points are taken for closed.
enum class ClosedPoints {
    bonded,    ///< bonded ones, and closed joints; touching ones in a world without bonds. Walls left out.
    touching,  ///< all that carry load now, walls included
    listed,    ///< all that may come to carry load before the neighbour list is rebuilt
};

/// row·u, m: with a spring's gradient what the displacements stretch it by, along the normal the growth of the overlap.
double times(const Spring& spring, const OverlapGradient& row, const std::vector<BodyMotion>& displacement);

/// Springs whose sum of ½k(push·u)² is nowhere less than |u·Ku|: unsymmetric ones become two of half the stiffness,
/// ½k(s a aᵀ + g gᵀ/s) with s = |g|/|a| in the mass-scaled norm. Bounds every real eigenvalue.
std::vector<Spring> symmetric_majorant(const World& world, const std::vector<Spring>& springs);

/// |row|² in mass-scaled coordinates: the row's own stiffness over mass for a unit spring, 1/kg.
double scaled_square(const World& world, const OverlapGradient& row, BodyIndex i, BodyIndex j);

/// Springs in the order of the points; those of no stiffness and no damping are left out.
std::vector<Spring> springs_of(const World& world, ClosedPoints which);

}  // namespace crackle
