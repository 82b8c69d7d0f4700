// SPDX-License-Identifier: GPL-3.0-or-later
// Back-tension bond (BondLaw::back_tension): the overlap at bonding determines the strength.
//
//     bonded       f_n = k_n(δ - δ0), |f_t| <= μ k_n δ (friction.hpp); holds while  δ > 0
//     afterwards   f_n = k_n δ
//
// δ0 overlap at bonding [m]. The tensile strength is k_n δ0, the shear strength at zero load μ k_n δ0. An unbreakable
// bond holds at any δ. The energy released by a break is
//     ½k_n(δ-δ0)' (δ-δ0) + ½f_t' f_t/k_s   ->   ½k_n(δ-δ0)² + ½f_t²/k_s, as Δt -> 0,
// where primes denote values before the step. If a spring's force has changed sign within that step, it passed through
// 0, and the spring's term counts as 0. A break is in shear if the point had reached its Coulomb limit since bonding,
// and |f_t| > |f_n| in the last step in which it carried at least half its strength. Otherwise it is in tension.
// Source: DEMseg guide; solver/MODEL.md 5.1.
// Tested by tests/solver/laws/bond_law_test.cpp.
#pragma once

#include <cmath>
#include <limits>

#include "solver/laws/bond_law.hpp"
#include "solver/laws/bonded_point.hpp"
#include "solver/laws/friction.hpp"

namespace crackle {

/// The guide's law: a bond is as strong as the back-tension with which it was made (the file's comment has the
/// formulas).
struct BackTensionBond {
    static constexpr BondLaw law = BondLaw::back_tension;
    static constexpr BondLawFacts facts{
        .meaning = "the overlap at the time of bonding determines the strength, as in DEMseg's guide",
        .with_guide_segments = true,
        .remembers_strong_forces = true};

    /// Whether a bond breaks in this force pass (stepping/record_breaks.cpp records it).
    template <class Number>
    static CRACKLE_INLINE Condition<Number> fails(const Law<Number>& law, const BondedPoint<Number>& p) {
        return opposite(p.overlap > law.break_overlap);
    }

    /// Normal force, N. @param contact the normal force without a bond, N @param bond_overlap the overlap at bonding,
    /// m; 0 if not bonded
    template <class Number>
    static CRACKLE_INLINE Number with_back_tension(const Law<Number>& law, const Number& contact,
                                                   const Number& bond_overlap) {
        return contact - spring_force(law, bond_overlap);
    }

    /// Largest shear force, N. @param compression the overlap that determines the Coulomb limit, m
    template <class Number>
    static CRACKLE_INLINE Number shear_limit(const Law<Number>& law, const Condition<Number>& /*bonded*/,
                                             const Number& /*normal*/, const Number& compression) {
        return coulomb_limit(law, compression);
    }

    /// Whether a bonded point carries at least half its strength k_n δ0.
    template <class Number>
    static CRACKLE_INLINE Condition<Number> carries_half_strength(const Law<Number>& law,
                                                                  const BondForces<Number>& force,
                                                                  const Number& bond_overlap) {
        const Number half = law.half_stiffness * bond_overlap;
        return force.normal * force.normal + force.shear * force.shear >= half * half;
    }

    /// Half the product of a spring's elongations, or forces, at two consecutive steps; 0 if the sign has changed. It
    /// is the stored energy divided by the stiffness (elongations), or times the stiffness (forces).
    static double half_product(double before, double now) { return before * now > 0.0 ? 0.5 * before * now : 0.0; }

    /// State after a break, and the energy released. The bond breaks at an overlap of 0, so no force remains.
    static BrokenBond break_bond(const Law<double>& law, const BondedPoint<double>& p, const BondMemory& memory = {}) {
        BrokenBond broken{};
        const double opening = p.overlap - p.bond_overlap;
        broken.energy = memory.normal_work
                            ? *memory.normal_work
                            : law.normal_stiffness * half_product(opening - p.drift * p.closing, opening);
        if (law.has_shear_spring) {
            const double now = p.shear_force - law.shear_stiffness * p.drift * p.slipping;
            broken.energy += half_product(now, p.shear_force) / law.shear_stiffness;
        }
        broken.strength = law.normal_stiffness * p.bond_overlap;
        broken.reported = memory.strong;
        broken.slid = memory.slid;
        broken.in_shear = memory.slid && std::abs(memory.strong.shear) > std::abs(memory.strong.normal);
        return broken;
    }

    /// Strains at a bond's limits under proportional loading. @param law its law @param held whether it is unbreakable
    static ElasticLimits elastic_limits(const ContactLaw& law, double bond_overlap, bool held,
                                        const BondGrowth& growth) {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        const double strength = held ? infinite : law.normal_stiffness * bond_overlap;
        // Strain at which the shear force reaches the Coulomb limit. Without a shear spring or a limit, the point never
        // slides.
        const double slips =
            growth.shear.value > growth.shear.error && std::isfinite(law.friction)
                ? strain_of_loss(law.friction * strength,
                                 {law.friction * law.normal_stiffness * growth.closing.value - growth.shear.value,
                                  law.friction * growth.normal.error + growth.shear.error})
                : infinite;
        return {strength, strain_of_loss(strength, growth.normal), slips};
    }
};

}  // namespace crackle
