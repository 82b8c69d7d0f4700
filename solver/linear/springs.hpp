// SPDX-License-Identifier: GPL-3.0-or-later
// Linear springs and dashpots that represent the contact points of a world, from which the sparse matrices are
// assembled.
//
// The stretch of a point along its normal or tangent is
//     a = d·(u_i - u_j) + (r_i × d) θ_i - (r_j × d) θ_j,      d = n or t, r the arms from the centroids
// linearised about the current positions; the stored energy is ½k a². Contact forces are zero after back-tension
// bonding, so there is no geometric stiffness. Under the DEMseg guide's segment law a normal spring pushes along a,
// too, but the overlap changes by g·u (PointView::overlap_gradient). The stiffness matrix k a gᵀ is therefore
// unsymmetric. Tested by tests/verification/claims_test.cpp.
#pragma once

#include <vector>

#include "solver/geometry/overlap_gradient.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Displacement (m) and rotation (rad) of a body; also used for force (N) and moment (N m).
struct BodyMotion {
    double x = 0.0, y = 0.0, rotation = 0.0;
};
/// Component of a motion. @param d 0 for x and 1 for y (m), 2 for the rotation (rad)
inline double component(const BodyMotion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }
/// Reference to a component of a motion. @param d 0 for x and 1 for y (m), 2 for the rotation (rad)
inline double& component(BodyMotion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }

/// A spring with its dashpot. Each contact point has one spring along its normal and one along its tangent.
struct Spring {
    BodyIndex i, j;            ///< the two bodies; j is no_body for a domain wall
    PointIndex point;          ///< index into Points::contact
    bool shear;                ///< whether the spring acts along the tangent
    double stiffness;          // N/m
    double damping;            // N s/m
    OverlapGradient push;      ///< generalised direction of the spring's force: (x, y, rotation) of i, then of j
    OverlapGradient gradient;  ///< derivative of its stretch with respect to u; equal to `push` except for normal
                               ///< springs under the DEMseg guide's segment law

    /// Whether the force works along the gradient of the overlap, so that the spring's matrix is symmetric.
    bool symmetric() const { return push == gradient; }
};

/// Which contact points are represented by springs.
enum class ClosedPoints {
    bonded,    ///< bonded points and closed joints; in a world without bonds, points in contact; no walls
    touching,  ///< all points that currently carry load, including walls
    listed,    ///< all points that may carry load before the neighbour list is rebuilt
};

/// Product row·u, m. For the gradient of a spring, it is the change of the spring's stretch, and for a normal spring
/// the increase of the overlap.
double times(const Spring& spring, const OverlapGradient& row, const std::vector<BodyMotion>& displacement);

/// Springs for which the sum of ½k(push·u)² is at least |u·Ku| for every u. An unsymmetric spring is replaced by two
/// symmetric springs of half the stiffness, ½k(s a aᵀ + g gᵀ/s), where s = |g|/|a| in the mass-scaled norm. The result
/// bounds every real eigenvalue.
std::vector<Spring> symmetric_majorant(const World& world, const std::vector<Spring>& springs);

/// |row|² in mass-scaled coordinates, 1/kg: the squared frequency of a spring of unit stiffness along the row.
double scaled_square(const World& world, const OverlapGradient& row, BodyIndex i, BodyIndex j);

/// Springs of a world, in point order. Springs with neither stiffness nor damping are omitted.
std::vector<Spring> springs_of(const World& world, ClosedPoints which);

}  // namespace crackle
