// SPDX-License-Identifier: GPL-3.0-or-later
// Updates the contact between two flat faces during the force pass: before its force is computed, and after the faces
// have separated.
//
// While the faces touch, the rest overlap (at which their force is zero) follows the closure caused by rotation of the
// circles (flat_faces.hpp). While the faces separate, the rest overlap decreases at most as fast as the overlap;
// otherwise the faces would touch again at once, and the contact would create energy. As unbonded faces slide, the
// length λ over which they lie opposite each other (their lap) changes, but the elongations of the springs do not. The
// stiffness K λ, and hence the stored energy, then changes by an amount that is not the work of a force:
//
//     ½ K_n δ(n-1) δ(n) (λ(n) - λ(n-1)) + ½ f_t²/(K_s λ(n-1)) (λ(n)/λ(n-1) - 1),     f_t <- f_t λ(n)/λ(n-1)
//
// where K is the stiffness for a lap of one metre. This amount is the increase of ½ K λ δ² minus the work computed by
// the trapezoidal rule; it is recorded as a loss of the law. If one pair of faces loses as much lap as the next pair
// gains, the changes cancel: the laps along a row of faces always sum to its length.
// Source: solver/MODEL.md 5.4.
// Tested by tests/solver/geometry/flat_faces_test.cpp and tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "solver/contact/batch.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/geometry/flat_faces.hpp"

namespace crackle {

/// Values that two flat faces keep between steps.
template <class Number>
struct FaceMemory {
    Number rest;   // m, overlap at which the force is zero (Points::bond_overlap)
    Number lap;    // m
    Number shear;  // N
};

/// Updates the faces for the motion during a drift. @param touched whether the faces touched or were bonded in the last
/// force pass @param law the law, with stiffnesses for a lap of one metre
/// @return the energy that the springs gain because the lap changes, J
template <class Number>
CRACKLE_INLINE Number follow(FaceMemory<Number>& memory, const FlatFaceGeometry<Number>& g, const PairMotion<Number>& m,
                             const Number& closing, const Law<Number>& law, const Condition<Number>& touched,
                             const Condition<Number>& bonded, double drift) {
    const Number zero{};
    const Number sliding = m.vx * g.ny - m.vy * g.nx;  // m/s, rate of change of the offset
    memory.rest = select(
        touched, memory.rest + 0.5 * drift * (g.offset - 0.5 * drift * sliding) * (m.spin_i + m.spin_j), memory.rest);
    const Number before = memory.lap, now = select(bonded, before, g.lap());
    const Condition<Number> changed = now != before;
    if (!any(changed)) return zero;
    memory.lap = now;
    const Number overlap = g.closed - memory.rest, overlap_before = overlap - closing * drift;
    const Number pressed = 0.5 * law.normal_stiffness * select(overlap > 0.0, overlap, zero) *
                           select(overlap_before > 0.0, overlap_before, zero);
    const Condition<Number> sheared = changed & (before > 0.0) & (memory.shear != 0.0);
    const Number gained = pressed * (now - before);
    if (!any(sheared)) return gained;
    const Number lap = select(sheared, before, all_of<Number>(1.0)), ratio = now / lap;
    const Number strained = 0.5 * memory.shear * memory.shear / (law.shear_stiffness * lap) * (ratio - 1.0);
    memory.shear = select(sheared, memory.shear * ratio, memory.shear);
    return gained + select(sheared, strained, zero);
}

/// Updates the two faces at one contact point.
inline void follow_faces(const PassView& view, PointIndex k, BlockLosses& loss) {
    const ContactPoint point = point_of<PointKind::face_face>(view, k);
    const FlatFaceContact g = flat_face_contact(view.bodies, point);
    const BodyState &i = view.bodies.state[point.body_i], &j = view.bodies.state[point.body_j];
    const std::uint16_t flags = view.state[k].flags;
    const Law<double> whole(view.laws[view.state[k].law]);
    const double share = view.stiffness_share[k];
    const Law<double> law =
        view.shear_root == nullptr ? whole.with_share(share) : whole.with_shares(share, view.shear_root[k]);
    FaceMemory<double> memory{view.bond_overlap[k], view.lap[k], view.shear_force[k]};
    loss.law -= follow<double>(memory, g, {i.vx - j.vx, i.vy - j.vy, i.omega, j.omega},
                               motion_of_point<PointKind::face_face>(view, point, g).closing, law,
                               (flags & (point_bonded | point_touching)) != 0, (flags & point_bonded) != 0, view.drift);
    view.bond_overlap[k] = memory.rest, view.lap[k] = memory.lap, view.shear_force[k] = memory.shear;
}

/// Updates the faces at all points in a batch. @param law on entry the law of the previous batch, on return the law of
/// this batch
template <class Features>
CRACKLE_INLINE void follow_batch(const Features& has, const PassView& view, PointIndex k, const FaceBatch& g,
                                 BatchLaw& law, BlockLosses& loss) {
    const PointState* const states = view.state + k;
    const LaneBits law_and_flags = state_bits<Lanes>(states);
    if (!none_of((law_and_flags ^ law.number) & bits_of_law) && !take_laws(has, view, states, law_and_flags, law)) {
        for (PointIndex l = 0; l < lane_count; ++l) follow_faces(view, k + l, loss);
        return;
    }
    double *const rest = view.bond_overlap + k, *const lap = view.lap + k, *const shear = view.shear_force + k;
    Law<Lanes> room;
    const Law<Lanes>& of_metre =
        with_shares_of(has, view, k, law.law, room, [&] { return load_floats<Lanes>(view.stiffness_share + k); });
    FaceMemory<Lanes> memory{load_as<Lanes>(rest), load_as<Lanes>(lap), load_as<Lanes>(shear)};
    const Lanes gained =
        follow<Lanes>(memory, g.contact, g.pair, g.motion.closing, of_metre,
                      (law_and_flags & (bits_of_flags(point_bonded) | bits_of_flags(point_touching))) != 0,
                      (law_and_flags & bits_of_flags(point_bonded)) != 0, view.drift);
    store_as(rest, memory.rest);
    store_as(lap, memory.lap);
    store_as(shear, memory.shear);
    if (any(gained != 0.0))
        for (int l = 0; l < lane_count; ++l) loss.law -= gained[l];
}

/// Updates the overlap at which separated faces that were never bonded will touch again, m. Rotation may have raised it
/// above the joint's aperture. As the faces open, it decreases with the overlap, but not below the aperture.
inline void part_faces(const PassView& view, PointIndex k, double closed) {
    const PointState& state = view.state[k];
    if ((state.flags & point_had_bond) != 0 || state.law < view.first_joint_law) return;
    double& rest = view.bond_overlap[k];
    rest = std::max(view.joint_of_law(state.law).aperture, std::min(rest, closed));
}

/// Calls part_faces() for the points in a batch that carry no load.
CRACKLE_INLINE void part_batch(const PassView& view, PointIndex k, const FaceBatch& g, const BatchState& batch) {
    const LaneBits laws = batch.law_and_flags & bits_of_law;
    const LaneBits parted = ~batch.holds & ((batch.law_and_flags & bits_of_flags(point_had_bond)) == 0) &
                            (laws >= static_cast<LaneBit>(view.first_joint_law));
    if (!any(parted)) return;
    if (!none_of(laws ^ laws[0])) {
        for (PointIndex l = 0; l < lane_count; ++l)
            if (parted[l] != 0) part_faces(view, k + l, g.contact.closed[l]);
        return;
    }
    const Lanes aperture = all_of<Lanes>(view.joint_of_law(static_cast<std::size_t>(laws[0])).aperture);
    double* const memory = view.bond_overlap + k;
    const Lanes rest = load_as<Lanes>(memory), closed = g.contact.closed;
    const Lanes least = select(closed < rest, closed, rest);
    store_as(memory, select(parted, select(aperture < least, least, aperture), rest));
}

}  // namespace crackle
