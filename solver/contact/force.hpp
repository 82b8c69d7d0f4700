// SPDX-License-Identifier: GPL-3.0-or-later
// Force of contact points that carry load. The same template handles one point (Number is double) and a batch of points
// (Number is Lanes), with bit-identical results. The bond law's type defines how bonds behave (laws/bond_laws.hpp).
// Steps in which a contact opens or a bond breaks are handled in kernels.cpp.
// Tested by tests/solver/contact/force_test.cpp and tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstdint>
#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/contact/losses.hpp"
#include "solver/contact/opening_points.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/contact/point_law.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/laws/bond_laws.hpp"
#include "solver/laws/dashpot.hpp"
#include "solver/laws/friction.hpp"
#include "solver/laws/law.hpp"

namespace crackle {

/// Type for the law index and flags of one point, or of a batch. Bits 0 to 15 hold the law index, bits 16 to 31 the
/// flags.
template <class Number>
using StateBits = std::conditional_t<std::is_same_v<Number, double>, LaneBit, LaneBits>;

constexpr LaneBit bits_of_flags(int flags) { return static_cast<LaneBit>(flags) << 16; }
inline constexpr LaneBit bits_of_law = 0xffff;

// Law index and flags of one point, or of the points in a batch.
template <class Number>
CRACKLE_INLINE StateBits<Number> state_bits(const PointState* states) {
    if constexpr (std::is_same_v<Number, double>)
        return bits_of_flags(states->flags) | LaneBit{states->law};
    else
        return widened(states);
}

// Stores the flags of the points for which `where` is true.
CRACKLE_INLINE void store_flags(PointState* states, bool where, LaneBit bits) {
    if (where) states->flags = static_cast<std::uint16_t>(bits >> 16);
}
CRACKLE_INLINE void store_flags(PointState* states, const LaneBits& where, const LaneBits& bits) {
    if (const unsigned these = mask_of(where); these != 0) {
        for (int l = 0; l < lane_count; ++l)
            if ((these >> l & 1) != 0) states[l].flags = static_cast<std::uint16_t>(bits[l] >> 16);
    }
}

// Returns `bits` where the condition is true, and 0 elsewhere.
CRACKLE_INLINE LaneBit bits_where(bool condition, LaneBit bits) { return condition ? bits : 0; }
CRACKLE_INLINE LaneBits bits_where(const LaneBits& condition, LaneBit bits) { return condition & bits; }

CRACKLE_INLINE void store_forces(PointForce* out, const ForceOnBodies<double>& force) {
    *out = {force.fx, force.fy, force.torque_i, force.torque_j};
}
CRACKLE_INLINE void store_forces(PointForce* out, const ForceOnBodies<Lanes>& force) {
    store_quads(out, force.fx, force.fy, force.torque_i, force.torque_j);
}

/// Overlap minus the overlap at which the normal force, without back-tension, is zero, m. Flat faces without a lap
/// (shared length) never overlap.
template <PointKind K, class Features, class Number>
CRACKLE_INLINE Number beyond_rest(const Features& has, const PassView& view, PointIndex k, Number overlap) {
    if (has.bonds && Features::Bond::facts.from_rest_overlap) overlap -= load_as<Number>(view.bond_overlap + k);
    if constexpr (K == PointKind::face_face)
        return select((load_as<Number>(view.lap + k) == 0.0) & (overlap > 0.0), Number{}, overlap);
    else
        return overlap;
}

/// State of one point that carries load, or of the points in a batch; `holds` marks the points that carry load.
template <class Number>
struct HeldPoints {
    PointState* states;
    StateBits<Number> law_and_flags;
    Condition<Number> bonded, holds;
    Number overlap;  // m, as returned by beyond_rest()
};

/// Adds the work done on the spring during the last drift, by the trapezoidal rule. @param now the current normal
/// force, N
inline void store_work(SpringWork& work, const PassView& view, const ContactPoint& point, double now, double closing) {
    const BodyState &i = view.bodies.state[point.body_i], &j = view.bodies.state[point.body_j];
    const double given_back = work.last.fx * (i.vx - j.vx) + work.last.fy * (i.vy - j.vy) +
                              work.last.torque_i * i.omega + work.last.torque_j * j.omega;
    work.stored += 0.5 * view.drift * (now * closing - given_back);
}

/// Updates the work stored in a point's normal spring under the DEMseg guide's segment law.
inline void keep_work(const PassView& view, PointIndex k, const ContactPoint& point, const ContactGeometry& g,
                      double normal, double closing, const Law<double>& law) {
    SpringWork& work = view.spring_work[k];
    if (view.account_begun) {
        store_work(work, view, point, normal, closing);
    } else {
        work.stored = 0.5 * normal * normal / law.normal_stiffness;  // the energy account of this spring starts here
    }
    const double fx = -normal * g.nx, fy = -normal * g.ny;
    work.last = {fx, fy, g.aix * fy - g.aiy * fx, g.ajy * fx - g.ajx * fy};
}

/// Computes the forces of points that carry load and writes them to `out`; the other points in a batch get no
/// force. Updates shear springs, dashpots, flags and losses.
/// @tparam All whether every point was in contact without sliding and still carries load, and (with bonds) is bonded
/// @param place the first point's position in its block @param law the law, including the points' stiffness factors
template <bool All, PointKind K, class Features, class Number, class Contact>
CRACKLE_INLINE void force_of_held(const Features& has, const PassView& view, PointIndex k, PointIndex place,
                                  const Contact& g, const RelativeMotion<Number>& motion, const Law<Number>& law,
                                  const HeldPoints<Number>& held, const ContactSpring<Number>& spring, PointForce* out,
                                  BlockLosses& loss) {
    using Bond = typename Features::Bond;
    const Number zero{};
    const auto where_held = [&](const Number& value, const Number& otherwise) -> Number {
        if constexpr (All || std::is_same_v<Number, double>)
            return value;
        else
            return select(held.holds, value, otherwise);
    };
    Number normal = spring.force;
    [[maybe_unused]] Number bond_overlap{};
    if (has.bonds) {
        bond_overlap = load_as<Number>(view.bond_overlap + k);
        normal = Bond::with_back_tension(law, normal, bond_overlap);
    }
    if constexpr (by_guide(K)) keep_work(view, k, point_of<K>(view, k), g, normal, motion.closing, law);
    Number shear = zero;
    Condition<Number> sliding = held.holds;
    if (has.friction) {
        double* const force = view.shear_force + k;
        const Number before = load_as<Number>(force);
        Number limit;
        if (has.bonds)
            limit = Bond::shear_limit(law, All ? zero == zero : held.bonded, normal, spring.compression);
        else
            limit = coulomb_limit(law, spring.compression);
        const ShearTrial<Number> trial = try_shear_within<Number>(law, before, motion.slipping * view.drift, limit);
        sliding = trial.slides;
        shear = trial.force;
        const Condition<Number> slides = sliding & held.holds;
        if (any(slides)) shear = shear_force(trial);
        store_as(force, where_held(shear, before));
        if (any(slides)) {
            loss.add_friction(slides, slider_loss(law, trial, shear));
            if constexpr (All)
                store_flags(held.states, slides, held.law_and_flags | bits_of_flags(point_sliding | point_slid));
        }
    }
    if constexpr (!All) {
        StateBits<Number> now = (held.law_and_flags | bits_of_flags(point_touching)) & ~bits_of_flags(point_sliding);
        if (has.friction) now |= bits_where(sliding, bits_of_flags(point_sliding | point_slid));
        store_flags(held.states, held.holds & ((now ^ held.law_and_flags) != 0), now);
        if (has.bonds) loss.gained += count_of(held.holds & ((held.law_and_flags & bits_of_flags(point_counted)) == 0));
    }
    if constexpr (Bond::facts.remembers_strong_forces) {
        if (has.bonds) {
            Condition<Number> strong = Bond::template carries_half_strength<Number>(law, {normal, shear}, bond_overlap);
            if constexpr (!All) strong = strong & held.bonded;
            if (any(strong)) {  // this is rarely true, so that these arrays are usually not touched
                float *const strong_normal = view.strong_normal + k, *const strong_shear = view.strong_shear + k;
                store_floats(strong_normal, select(strong, normal, load_floats<Number>(strong_normal)));
                store_floats(strong_shear, select(strong, shear, load_floats<Number>(strong_shear)));
            }
        }
    }
    if (has.damping) {
        const Number root_mass = root_masses<K, Number>(view, k);
        const Number normal_damper = normal_damping(law, root_mass) * motion.closing;
        const Number shear_damper = shear_dashpot(law, root_mass, motion.slipping, spring.compression, sliding);
        float *const normal_memory = view.normal_dashpot + k, *const shear_memory = view.shear_dashpot + k;
        const Number last_normal = load_floats<Number>(normal_memory), last_shear = load_floats<Number>(shear_memory);
        const Number lost = dashpot_loss<Number>(view.drift, last_normal + normal_damper, motion.closing,
                                                 last_shear + shear_damper, motion.slipping);
        loss.add_dashpots(place, where_held(lost, zero));
        store_floats(normal_memory, where_held(normal_damper, last_normal));
        store_floats(shear_memory, where_held(shear_damper, last_shear));
        normal += normal_damper;
        shear -= shear_damper;
    }
    if (has.consistent && !(has.bonds && All)) {
        double* const last = view.last_normal + k;
        store_as(last, select(held.bonded, load_as<Number>(last), where_held(normal, load_as<Number>(last))));
        remember_overlaps(view, k, held.bonded, held.overlap);
    }
    const ForceOnBodies<Number> force = force_on_bodies(g, normal, shear);
    store_forces(out, ForceOnBodies<Number>{where_held(force.fx, zero), where_held(force.fy, zero),
                                            where_held(force.torque_i, zero), where_held(force.torque_j, zero)});
}

}  // namespace crackle
