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
// Source: solver/MODEL.md 5.4. Tested by tests/solver/geometry/flat_faces_test.cpp and
// tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "solver/contact/batch.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// What is remembered of two faces.
template <class Number>
struct FaceMemory {
    Number rest;   // m, overlap without force: Points::bond_overlap
    Number lap;    // m
    Number shear;  // N
};

/// Follows the motion of a drift. @param touched or bonded, in the last force pass @param law with the share of a metre
/// @return J, that the springs have gained by another lap
template <class Number>
CRACKLE_INLINE Number follow(FaceMemory<Number>& memory, const FlatFaceGeometry<Number>& g, const PairMotion<Number>& m,
                             const Number& closing, const Law<Number>& law, const Condition<Number>& touched,
                             const Condition<Number>& bonded, double drift) {
    const Number zero{};
    const Number sliding = m.vx * g.ny - m.vy * g.nx;  // m/s, of the offset
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

/// Of one point.
inline void follow_faces(World& world, PointIndex k, BlockLosses& loss) {
    Points& points = world.points;
    const ContactPoint point = point_of<PointKind::face_face>(world, k);
    const FlatFaceContact g = flat_face_contact(world, point);
    const BodyState &i = world.bodies.state[point.body_i], &j = world.bodies.state[point.body_j];
    const std::uint16_t flags = points.state[k].flags;
    const Law<double> whole(world.settings.laws[points.state[k].law]);
    const double share = points.stiffness_share[k];
    const Law<double> law =
        points.shear_root.empty() ? whole.with_share(share) : whole.with_shares(share, points.shear_root[k]);
    FaceMemory<double> memory{points.bond_overlap[k], points.lap[k], points.shear_force[k]};
    loss.law -= follow<double>(memory, g, {i.vx - j.vx, i.vy - j.vy, i.omega, j.omega},
                               motion_of_point<PointKind::face_face>(world, point, g).closing, law,
                               (flags & (point_bonded | point_touching)) != 0, (flags & point_bonded) != 0,
                               world.stepping.drift);
    points.bond_overlap[k] = memory.rest, points.lap[k] = memory.lap, points.shear_force[k] = memory.shear;
}

/// Of a batch. @param law of the batch before; left as this one's
template <class Features>
CRACKLE_INLINE void follow_batch(const Features& has, World& world, PointIndex k, const FaceBatch& g, BatchLaw& law,
                                 BlockLosses& loss) {
    const PointState* const states = world.points.state.data() + k;
    const LaneBits law_and_flags = widened(states);
    if (!none_of((law_and_flags ^ law.number) & bits_of_law) && !take_laws(has, world, states, law_and_flags, law)) {
        for (PointIndex l = 0; l < lane_count; ++l) follow_faces(world, k + l, loss);
        return;
    }
    double *const rest = &world.points.bond_overlap[k], *const lap = &world.points.lap[k],
                  *const shear = &world.points.shear_force[k];
    FaceMemory<Lanes> memory{load_as<Lanes>(rest), load_as<Lanes>(lap), load_as<Lanes>(shear)};
    const Lanes gained =
        follow<Lanes>(memory, g.contact, g.pair, g.motion.closing, law_of_metre(has, world, k, law),
                      (law_and_flags & (bits_of_flags(point_bonded) | bits_of_flags(point_touching))) != 0,
                      (law_and_flags & bits_of_flags(point_bonded)) != 0, world.stepping.drift);
    store_as(rest, memory.rest);
    store_as(lap, memory.lap);
    store_as(shear, memory.shear);
    if (any(gained != 0.0))
        for (int l = 0; l < lane_count; ++l) loss.law -= gained[l];
}

/// m, of faces without a bond that do not touch: where they meet. They opened where that has turned to, and meet there
/// again; once they are open wider, where they first did, but for what they opened by as they slid.
inline void part_faces(World& world, PointIndex k, double closed) {
    const PointState& state = world.points.state[k];
    if ((state.flags & point_had_bond) != 0 || state.law < world.settings.first_joint_law()) return;
    double& rest = world.points.bond_overlap[k];
    rest = std::max(world.settings.joint_of_law(state.law).aperture, std::min(rest, closed));
}

/// Of the points of a batch that do not hold.
CRACKLE_INLINE void part_batch(World& world, PointIndex k, const FaceBatch& g, const BatchState& batch) {
    const LaneBits laws = batch.law_and_flags & bits_of_law;
    const LaneBits parted = ~batch.holds & ((batch.law_and_flags & bits_of_flags(point_had_bond)) == 0) &
                            (laws >= static_cast<LaneBit>(world.settings.first_joint_law()));
    if (!any(parted)) return;
    if (!none_of(laws ^ laws[0])) {
        for (PointIndex l = 0; l < lane_count; ++l)
            if (parted[l] != 0) part_faces(world, k + l, g.contact.closed[l]);
        return;
    }
    const Lanes aperture = all_of<Lanes>(world.settings.joint_of_law(static_cast<std::size_t>(laws[0])).aperture);
    double* const memory = &world.points.bond_overlap[k];
    const Lanes rest = load_as<Lanes>(memory), closed = g.contact.closed;
    const Lanes least = select(closed < rest, closed, rest);
    store_as(memory, select(parted, select(aperture < least, least, aperture), rest));
}

}  // namespace crackle
