// SPDX-License-Identifier: GPL-3.0-or-later
// Bond with given strengths (BondLaw::coulomb): tension cut-off, cohesion and friction.
//
//     bonded       f_n = k_n(δ - δ0), f_t elastic, no slip; holds while  f_n > -T  and  |f_t| < C + μ f_n
//     afterwards   f_n = k_n max(0, δ - max(δ0, 0)),  |f_t| <= μ_r f_n
//
// T tensile strength, C cohesion, N; μ friction coefficient of the bond, μ_r residual friction coefficient; f_n > 0
// pushes. The pair keeps its rest overlap max(δ0, 0). Otherwise it would push with k_n δ0 after a break in shear, which
// creates energy. If both limits are exceeded in one step, the failure mode is the limit that the straight path of
// (f_n, f_t) reaches first; at the apex μT = C it is tension. Let x' and x be the elongations δ - δ0 before and after
// the step, and f_t' and f_t the forces of the shear spring. With y and h the normal elongation and shear force that
// remain after the break, its energy by the trapezoidal rule is
//     ½k_n(x' + y)(x - y) + ½(f_t' + h)(f_t - h)/k_s   ->   strain energy before less that after, >= 0, as Δt -> 0,
// where a negative term counts as 0, since its force passed through 0 within the step. Source: solver/MODEL.md 5.2;
// verified by tests/solver/laws/coulomb_bond_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/laws/bond_law.hpp"
#include "solver/laws/bonded_point.hpp"
#include "solver/laws/friction.hpp"

namespace crackle {

/// A bond with a tensile strength, a cohesion and a friction angle (the file's comment has the formulas).
struct CoulombBond {
    static constexpr BondLaw law = BondLaw::coulomb;
    static constexpr BondConstant constants[]{
        {"tensile_strength", &BondConstants::tensile_strength, &ContactLaw::tensile_strength, false,
         "Tensile strength of a bond with law = \"coulomb\" or \"face\", in N per contact point, or in Pa in "
         "area units."},
        {"cohesion", &BondConstants::cohesion, &ContactLaw::cohesion, false,
         "Shear strength of a bond at zero normal force, in N per contact point or in Pa; at least tan(friction_angle) "
         "times tensile_strength."},
        {"residual_friction_angle", &BondConstants::residual_friction_angle, &ContactLaw::friction, true,
         "Friction angle of unbonded contacts, with law = \"coulomb\" or \"face\"; at most the friction_angle of "
         "bonds, and equal to it if not "
         "given."}};
    static constexpr BondLawFacts facts{.meaning = "bonds have the material's tensile strength, cohesion and friction",
                                        .constants = constants,
                                        .friction = &ContactLaw::bond_friction,
                                        .strengths_are_given = true,
                                        .bonds_across_gaps = true,
                                        .sticks = true,
                                        .from_rest_overlap = true,
                                        .own_shares = true,
                                        .across_joints = true};

    /// Strengths of a bonded point, including its strength factor.
    template <class Number>
    static CRACKLE_INLINE BondStrength<Number> strength_of(const Law<Number>& law, const BondedPoint<Number>& p) {
        return {law.tensile_strength * p.strength_share, law.cohesion * p.strength_share, law.bond_friction};
    }

    /// Elastic forces at the current positions.
    template <class Number>
    static CRACKLE_INLINE BondForces<Number> forces_now(const Law<Number>& law, const BondedPoint<Number>& p) {
        return {spring_force(law, p.overlap), p.shear_force - law.shear_stiffness * (p.slipping * p.drift)};
    }

    /// Whether a bond breaks in tension: f_n <= -T. @param normal elastic, N, compression positive
    template <class Number>
    static CRACKLE_INLINE Condition<Number> fails_in_tension(const BondStrength<Number>& strength,
                                                             const Number& normal) {
        return normal <= -strength.tensile;
    }

    /// Whether a bond breaks in shear: |f_t| >= C + μ f_n. @param normal N, compression positive @param shear N
    template <class Number>
    static CRACKLE_INLINE Condition<Number> fails_in_shear(const BondStrength<Number>& strength, const Number& normal,
                                                           const Number& shear) {
        return magnitude(shear) >= strength.cohesion + strength.friction * normal;
    }

    /// Whether a bond breaks in this force pass, at the present elastic forces.
    template <class Number>
    static CRACKLE_INLINE Condition<Number> fails(const Law<Number>& law, const BondedPoint<Number>& p) {
        const BondStrength<Number> strength = strength_of(law, p);
        const BondForces<Number> now = forces_now(law, p);
        return either(fails_in_tension(strength, now.normal), fails_in_shear(strength, now.normal, now.shear));
    }

    /// Normal force, N. @param contact k_n(δ - δ0), N
    template <class Number>
    static CRACKLE_INLINE Number with_back_tension(const Law<Number>& /*law*/, const Number& contact,
                                                   const Number& /*bond_overlap*/) {
        return contact;
    }

    /// Largest shear force, N: infinite while bonded. @param normal elastic normal force, N
    template <class Number>
    static CRACKLE_INLINE Number shear_limit(const Law<Number>& law, const Condition<Number>& bonded,
                                             const Number& normal, const Number& /*compression*/) {
        const Number unlimited = all_of<Number>(std::numeric_limits<double>::infinity());
        return select(bonded, unlimited, law.friction * normal);
    }

    /// Fraction of a step at which a limit is reached, from the linearly interpolated slack; infinite if it is not
    /// reached. @param slack_before, slack_now limit minus force before and after the step
    static double share_to_limit(double slack_before, double slack_now) {
        if (slack_now > 0.0) return std::numeric_limits<double>::infinity();
        return slack_before > slack_now ? std::max(0.0, slack_before / (slack_before - slack_now)) : 0.0;
    }

    /// Whether the shear limit is reached before the tension limit. @param before forces before the step, within both
    /// limits up to round-off
    static bool shear_comes_first(const BondStrength<double>& s, const BondForces<double>& before,
                                  const BondForces<double>& now) {
        const auto shear_slack = [&](const BondForces<double>& f) {
            return s.cohesion + s.friction * f.normal - std::abs(f.shear);
        };
        return share_to_limit(shear_slack(before), shear_slack(now)) <
               share_to_limit(s.tensile + before.normal, s.tensile + now.normal);
    }

    /// Breaks a bond. @param law law of the point, with μ_r @param opening current δ - δ0, m @param bond_overlap δ0, m
    static BrokenBond break_bond(const Law<double>& law, const BondStrength<double>& strength,
                                 const BondForces<double>& before, const BondForces<double>& now, double opening,
                                 double bond_overlap) {
        BrokenBond broken{};
        broken.in_shear = shear_comes_first(strength, before, now);
        broken.rest_overlap = std::max(bond_overlap, 0.0);
        const double left = std::max(0.0, opening + bond_overlap - broken.rest_overlap);  // remaining overlap, m
        broken.normal = spring_force(law, left);
        const ShearTrial<double> trial{before.shear, now.shear, law.friction * broken.normal,
                                       std::abs(now.shear) > law.friction * broken.normal};
        broken.shear = shear_force(trial);
        broken.strength = broken.in_shear ? strength.cohesion + strength.friction * now.normal : strength.tensile;
        broken.energy = std::max(0.0, 0.5 * (before.normal + broken.normal) * (opening - left)) +
                        std::max(0.0, slider_loss(law, trial, broken.shear));
        broken.reported = now;
        return broken;
    }
    /// The bond's state after its break, and the energy that the break releases. @param p the point before it
    static BrokenBond break_bond(const Law<double>& law, const BondedPoint<double>& p,
                                 const BondMemory& /*memory*/ = {}) {
        const BondForces<double> before{spring_force(law, p.overlap - p.closing * p.drift), p.shear_force};
        return break_bond(law, strength_of(law, p), before, forces_now(law, p), p.overlap, p.bond_overlap);
    }

    /// Limits of a bond whose forces grow in proportion to strain. It breaks in tension or in shear, whichever limit is
    /// reached first, and never slides before. @param law the point's law, including its strength factor
    static ElasticLimits elastic_limits(const ContactLaw& law, double /*bond_overlap*/, bool /*held*/,
                                        const BondGrowth& growth) {
        const double parts = strain_of_loss(law.tensile_strength, growth.normal);
        const double shears =
            strain_of_loss(law.cohesion, {law.bond_friction * growth.normal.value - growth.shear.value,
                                          law.bond_friction * growth.normal.error + growth.shear.error});
        return {law.tensile_strength, std::min(parts, shears), std::numeric_limits<double>::infinity()};
    }
};

}  // namespace crackle
