// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry and motion of one point as the scalar kernels take them, and what a coulomb bond that breaks leaves: the
// force pass and the record of breaks find the same numbers by the same code.
// Tested by tests/solver/contact/coulomb_bond_test.cpp.
#pragma once

#include "solver/contact/coulomb_bond.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/relative_motion.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Points::contact of a kind that is known, quicker: kernels take a point at a time here and there.
template <PointKind K>
inline ContactPoint point_of(const World& world, PointIndex k) {
    const BodyPair& pair = world.points.contact.pairs[k];
    if constexpr (K == PointKind::circle_circle) return {pair.body_i, pair.body_j, own_circle, own_circle};
    const PointParts& parts = world.points.contact.parts[k - world.points.kind_begin[1]];
    return {pair.body_i, pair.body_j, parts.element_i, parts.feature_j};
}

/// Geometry of a point: of two single circles as circles, of others with arms. The edge faced is remembered.
template <PointKind K>
inline auto geometry_of_point(World& world, PointIndex k) {
    const ContactPoint point = point_of<K>(world, k);
    if constexpr (K == PointKind::circle_circle) {
        return single_circles_contact(world.bodies.state[point.body_i], world.bodies.state[point.body_j]);
    } else if constexpr (K == PointKind::face_face) {
        return flat_face_contact(world, point);
    } else {
        return contact_geometry<K>(world, point, world.points.contact.parts[k - world.points.kind_begin[1]].feature_j);
    }
}
inline ContactGeometry with_arms(const ContactGeometry& g) { return g; }

template <PointKind K, class Geometry>
inline RelativeMotion<double> motion_of_point(const World& world, const ContactPoint& point, const Geometry& g) {
    const BodyState& i = world.bodies.state[point.body_i];
    const double drift = world.stepping.drift;
    if constexpr (K == PointKind::element_wall) {
        return motion_against_wall<double>(g, {i.vx, i.vy, i.omega, 0.0}, drift);
    } else {
        const BodyState& j = world.bodies.state[point.body_j];
        const PairMotion<double> pair{i.vx - j.vx, i.vy - j.vy, i.omega, j.omega};
        if constexpr (K == PointKind::circle_circle) {
            return relative_motion(g, pair);
        } else {
            return relative_motion(g, pair, drift);
        }
    }
}

/// Law of a point with its share of stiffness.
inline Law<double> law_of_point(const World& world, PointIndex k) {
    const Law<double> law(world.settings.laws[world.points.state[k].law]);
    if (world.points.stiffness_share.empty()) return law;
    const double share = share_of_stiffness(world, k);
    return world.points.shear_root.empty() ? law.with_share(share) : law.with_shares(share, world.points.shear_root[k]);
}

/// Of a bonded point.
struct PointMotion {
    double opening;            // m, δ - δ0
    double closing, slipping;  // m/s
};

inline BondStrength<double> bond_strength(const World& world, PointIndex k) {
    const ContactLaw& law = world.settings.laws[world.points.state[k].law];
    const double share = world.points.strength_share[k];
    return {law.tensile_strength * share, law.cohesion * share, law.bond_friction};
}

/// Elastic forces of a bonded point before the drift that led here.
inline BondForces forces_before(const World& world, PointIndex k, const Law<double>& law, const PointMotion& motion) {
    return {spring_force(law, motion.opening - motion.closing * world.stepping.drift), world.points.shear_force[k]};
}
/// And now.
inline BondForces forces_now(const World& world, PointIndex k, const Law<double>& law, const PointMotion& motion) {
    return {spring_force(law, motion.opening),
            world.points.shear_force[k] - law.shear_stiffness * (motion.slipping * world.stepping.drift)};
}

inline bool bond_fails(const World& world, PointIndex k, const Law<double>& law, const PointMotion& motion) {
    const BondStrength<double> strength = bond_strength(world, k);
    const BondForces now = forces_now(world, k, law, motion);
    return fails_in_tension(strength, now.normal) || fails_in_shear(strength, now.normal, now.shear);
}

inline BrokenBond broken_bond(const World& world, PointIndex k, const Law<double>& law, const PointMotion& motion) {
    return break_bond(law, bond_strength(world, k), forces_before(world, k, law, motion),
                      forces_now(world, k, law, motion), motion.opening, world.points.bond_overlap[k]);
}

}  // namespace crackle
