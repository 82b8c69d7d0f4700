// SPDX-License-Identifier: GPL-3.0-or-later
// Applies the consistent integrator (opening.hpp) to contact points: collects the values that it needs from the bodies
// and from the last force pass, for one point or for a batch. Leapfrog uses none of this.
// Tested by tests/solver/contact/opening_test.cpp and tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/lanes.hpp"
#include "solver/contact/opening.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/contact/point_law.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/laws/dashpot.hpp"
#include "solver/laws/law.hpp"

namespace crackle {

/// Stores the overlaps of unbonded points, whether closed or open, for use in the next force pass.
template <class Number>
CRACKLE_INLINE void remember_overlaps(const PassView& view, PointIndex k, const Condition<Number>& bonded,
                                      const Number& overlap) {
    LastOverlap* const last = view.last_overlap + k;
    store_as(last, select(bonded, load_as<Number>(last), overlap));
}

/// Bounds on the accelerations of a point's bodies, and their inverse masses.
template <PointKind K>
inline PushBounds<double> push_bounds(const PassView& view, const ContactPoint& point) {
    const PushBound& i = view.push_bound[point.body_i];
    if constexpr (K == PointKind::element_wall) return {i.acceleration, i.inverse_mass};
    const PushBound& j = view.push_bound[point.body_j];
    return {i.acceleration + j.acceleration, i.inverse_mass + j.inverse_mass};
}

/// Returns push_bounds() of each point in a batch.
CRACKLE_INLINE PushBounds<Lanes> push_bounds_of_batch(const PassView& view, PointIndex k) {
    const BodyPair* const points = view.pairs + k;
    const double *i[lane_count], *j[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &view.push_bound[points[l].body_i].acceleration;
        j[l] = &view.push_bound[points[l].body_j].acceleration;
    }
    Lanes acceleration_i, acceleration_j, inverse_mass_i, inverse_mass_j;
    gather_pairs(i, acceleration_i, inverse_mass_i);
    gather_pairs(j, acceleration_j, inverse_mass_j);
    return {acceleration_i + acceleration_j, inverse_mass_i + inverse_mass_j};
}

/// Whether every unbonded point that carries load certainly stays closed for another step. @param law the law,
/// including the points' stiffness factors @param free a mask of the points that carry load without a bond
template <PointKind K, class Features>
CRACKLE_INLINE bool none_opens(const Features& has, const PassView& view, PointIndex k, const Law<Lanes>& law,
                               const Lanes& overlap, const Lanes& closing, const LaneBits& free) {
    Lanes dashpot{};
    if (has.damping) dashpot = normal_damping(law, root_masses<K, Lanes>(view, k)) * closing;
    return none_of(free & ~stays_closed(law.normal_stiffness, overlap, closing, load_as<Lanes>(view.last_normal + k),
                                        dashpot, push_bounds_of_batch(view, k), view.kick, view.time_step));
}

/// Sets the inverse mass along the normal at the contact position, 1/kg, and the closing acceleration there in the last
/// kick, m/s2. Driving forces are not included; the resulting energy error enters the point's defect.
template <PointKind K>
inline void feel_bodies(const PassView& view, const ContactPoint& point, const ContactGeometry& g,
                        ClosingPoint& closing) {
    const auto add = [&](BodyIndex b, double arm_x, double arm_y, double sense) {
        const BodyInertia& inertia = view.inertia[b];
        const BodyForce& force = view.last_force[b];
        const double turn = arm_x * g.ny - arm_y * g.nx;
        closing.inverse_mass += inertia.inverse_mass_x * g.nx * g.nx + inertia.inverse_mass_y * g.ny * g.ny +
                                inertia.inverse_moment * turn * turn;
        closing.acceleration += sense * ((force.fx + inertia.mass * view.gravity.x) * inertia.inverse_mass_x * g.nx +
                                         (force.fy + inertia.mass * view.gravity.y) * inertia.inverse_mass_y * g.ny +
                                         force.torque * inertia.inverse_moment * turn);
    };
    add(point.body_i, g.aix, g.aiy, 1.0);
    if constexpr (K != PointKind::element_wall) add(point.body_j, g.ajx, g.ajy, -1.0);
}

/// State of an unbonded point in a force pass.
struct OpeningPoint {
    ClosingPoint coming;
    double before;  // m, overlap one step ago
    bool touched;
};

/// Completes the last step of an unbonded point. Call it in every force pass, whether or not the point carries load.
inline OpeningPoint settle_point(const PassView& view, PointIndex k, double stiffness, double overlap, double closing) {
    std::uint16_t& flags = view.state[k].flags;
    OpeningPoint point{{overlap, closing, 0.0, 0.0, stiffness, 0.0, view.drift, view.kick, view.time_step},
                       0.0,
                       // A point that overlaps before anything has moved counts as touching, since its closing step is
                       // not known.
                       (flags & point_touching) != 0 || view.drift == 0.0};
    double& last = view.last_overlap[k].value;
    point.before = settle_opening(view.opening[k], last, point.touched, point.coming);
    last = overlap;
    flags = static_cast<std::uint16_t>(flags & ~point_unsettled);
    return point;
}

/// Normal spring force and compression of an unbonded point that carries load.
template <PointKind K, class Features, class Geometry>
inline ContactSpring<double> opening_spring(const Features& has, const PassView& view, PointIndex k,
                                            const ContactPoint& bodies, const Geometry& g, const Law<double>& law,
                                            OpeningPoint& point) {
    ClosingPoint& coming = point.coming;
    if (has.damping) coming.dashpot = normal_damping(law, root_masses<K, double>(view, k)) * coming.closing;
    const double last = view.last_normal[k];
    if (point.touched && stays_closed(law.normal_stiffness, coming.overlap, coming.closing, last, coming.dashpot,
                                      push_bounds<K>(view, bodies), view.kick, view.time_step))
        return contact_spring(law, coming.overlap);
    feel_bodies<K>(view, bodies, with_arms(g), coming);
    OpeningMemory& memory = view.opening[k];
    const double force = opening_force(memory, last, point.touched, point.before, coming);
    if (memory.extra_force != 0.0) view.state[k].flags |= point_unsettled;
    return {force, force / law.normal_stiffness};
}

}  // namespace crackle
