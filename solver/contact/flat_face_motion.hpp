// SPDX-License-Identifier: GPL-3.0-or-later
// What the force pass does to the contact of two flat faces before its force is found, and once they have parted.
//
// While they touch, the overlap without force follows by what the turning of the circles closes them (flat_faces.hpp);
// it goes back as they part, no faster than they do: else they would meet at once, with energy from nowhere.
// The lap of faces without a bond follows as they slide, at what the springs are strained: the stiffness K λ changes
// and with it the energy that they store, by what no force has done:
//
//     ½ K_n δ(n-1) δ(n) (λ(n) - λ(n-1)) + ½ f_t²/(K_s λ(n-1)) (λ(n)/λ(n-1) - 1),     f_t <- f_t λ(n)/λ(n-1)
//
// K of a metre. It is what ½ K λ δ² gains beyond the work of the trapezoidal rule, goes to the account of the law, and
// adds up to nothing as one pair takes over from another: laps of a row of faces sum to its length.
// Source: solver/MODEL.md 5.4. Tested by tests/solver/geometry/flat_faces_test.cpp.
#pragma once

#include <algorithm>

#include "solver/contact/point_motion.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// @return J, that the springs have gained by another lap
inline double follow_faces(World& world, PointIndex k, const ContactPoint& point, const FlatFaceContact& g) {
    const BodyState &i = world.bodies.state[point.body_i], &j = world.bodies.state[point.body_j];
    const std::uint16_t flags = world.points.state[k].flags;
    const double dt = world.stepping.drift;
    double& rest = world.points.bond_overlap[k];
    if ((flags & (point_bonded | point_touching)) != 0) {
        const double sliding = (j.vy - i.vy) * g.nx - (j.vx - i.vx) * g.ny;  // m/s, of the offset
        rest += 0.5 * dt * (g.offset - 0.5 * dt * sliding) * (i.omega + j.omega);
    }
    double& lap = world.points.lap[k];
    const double now = g.lap(), before = lap;
    if ((flags & point_bonded) != 0 || now == before) return 0.0;
    lap = now;
    const ContactLaw law = law_with(world, k, world.points.stiffness_share[k]);
    const double overlap = g.closed - rest;
    const double closing = motion_of_point<PointKind::face_face>(world, point, g).closing;
    double gained =
        0.5 * law.normal_stiffness * std::max(0.0, overlap) * std::max(0.0, overlap - closing * dt) * (now - before);
    double& shear = world.points.shear_force[k];
    if (before > 0.0 && shear != 0.0) {
        const double ratio = now / before;
        gained += 0.5 * shear * shear / (law.shear_stiffness * before) * (ratio - 1.0);
        shear *= ratio;
    }
    return gained;
}

/// m, of faces without a bond that do not touch: where they meet. They opened where that has turned to, and meet there
/// again; once they are open wider, where they first did, but for what they opened by as they slid.
inline void part_faces(World& world, PointIndex k, const FlatFaceContact& g) {
    const PointState& state = world.points.state[k];
    if ((state.flags & point_had_bond) != 0 || state.law < world.settings.first_joint_law()) return;
    double& rest = world.points.bond_overlap[k];
    rest = std::max(world.settings.joint_of_law(state.law).aperture, std::min(rest, g.closed));
}

}  // namespace crackle
