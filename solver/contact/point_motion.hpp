// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry, motion and law of one point, and the values of a bonded point that its law needs. The force pass and the
// recording of breaks share this code, so that they get identical numbers.
// Tested by tests/solver/contact/force_test.cpp.
#pragma once

#include "solver/base/lanes.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/relative_motion.hpp"
#include "solver/laws/bonded_point.hpp"
#include "solver/laws/law.hpp"

namespace crackle {

/// A contact point of a kind known at compile time.
template <PointKind K>
inline ContactPoint point_of(const PassView& view, PointIndex k) {
    const BodyPair& pair = view.pairs[k];
    if constexpr (K == PointKind::circle_circle) return {pair.body_i, pair.body_j, own_circle, own_circle};
    const PointParts& parts = view.parts[k - view.circle_points];
    return {pair.body_i, pair.body_j, parts.element_i, parts.feature_j};
}

/// Geometry of a point: a CircleContact for two single circles, otherwise with lever arms. Updates the edge faced last.
template <PointKind K>
inline auto geometry_of_point(const PassView& view, PointIndex k) {
    const ContactPoint point = point_of<K>(view, k);
    if constexpr (K == PointKind::circle_circle) {
        return single_circles_contact(view.bodies.state[point.body_i], view.bodies.state[point.body_j]);
    } else if constexpr (K == PointKind::face_face) {
        return flat_face_contact(view.bodies, point);
    } else {
        return contact_geometry<K>(view.bodies, point, view.parts[k - view.circle_points].feature_j);
    }
}
/// Returns the geometry unchanged, since it already has lever arms.
inline ContactGeometry with_arms(const ContactGeometry& g) { return g; }

/// Closing and slip velocities at a point, m/s, for the current velocities of its bodies. @param g the point's current
/// geometry
template <PointKind K, class Geometry>
inline RelativeMotion<double> motion_of_point(const PassView& view, const ContactPoint& point, const Geometry& g) {
    const BodyState& i = view.bodies.state[point.body_i];
    if constexpr (K == PointKind::element_wall) {
        return motion_against_wall<double>(g, {i.vx, i.vy, i.omega, 0.0}, view.drift);
    } else {
        const BodyState& j = view.bodies.state[point.body_j];
        const PairMotion<double> pair{i.vx - j.vx, i.vy - j.vy, i.omega, j.omega};
        if constexpr (K == PointKind::circle_circle) {
            return relative_motion(g, pair);
        } else {
            return relative_motion(g, pair, view.drift);
        }
    }
}

/// Contact law of a point, including the point's own stiffness factors.
inline Law<double> law_of_point(const PassView& view, PointIndex k) {
    const Law<double> law(view.laws[view.state[k].law]);
    if (view.stiffness_share == nullptr) return law;
    const double share = view.lap == nullptr ? double{view.stiffness_share[k]} : view.stiffness_share[k] * view.lap[k];
    return view.shear_root == nullptr ? law.with_share(share) : law.with_shares(share, view.shear_root[k]);
}

/// Values of one bonded point, or of a batch, that the bond law needs. @param overlap the overlap, m: δ - δ0 if the law
/// has from_rest_overlap, otherwise δ
template <class Bond, class Number>
CRACKLE_INLINE BondedPoint<Number> bonded_point(const PassView& view, PointIndex k, const Number& overlap,
                                                const RelativeMotion<Number>& motion) {
    BondedPoint<Number> point{overlap,         load_as<Number>(view.bond_overlap + k), motion.closing,
                              motion.slipping, load_as<Number>(view.shear_force + k),  Number{},
                              view.drift};
    if constexpr (Bond::facts.strengths_are_given) point.strength_share = load_floats<Number>(view.strength_share + k);
    return point;
}

}  // namespace crackle
