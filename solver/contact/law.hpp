// SPDX-License-Identifier: GPL-3.0-or-later
// Force of one contact point: linear springs, dashpots, Coulomb limit, back-tension.
//
//     f_n = k_n(δ - δ0) + c_n dδ/dt          positive pushes apart; back-tension f_b = -k_n δ0 while bonded
//     f_t ← f_t - k_s Δu_t, |f_t| <= μ k_n δ  elastic part (friction.hpp); plus the dashpot -c_s du_t/dt while not
//                                             sliding (dashpot.hpp)
//
// δ overlap [m], δ0 overlap at bonding (0: not bonded), u_t displacement of i against j along the normal turned by +90
// degrees. The law is written once for any Number: a double, or Lanes of several points. Here are its constants and the
// normal spring. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/base/lanes.hpp"
#include "solver/world/settings.hpp"

namespace crackle {

/// A ContactLaw with its constants in all lanes of a Number, and what follows from them.
template <class Number>
struct Law {
    Law() = default;
    explicit CRACKLE_INLINE Law(const ContactLaw& law)
        : normal_stiffness(all_of<Number>(law.normal_stiffness)),
          shear_stiffness(all_of<Number>(law.shear_stiffness)),
          normal_damping(all_of<Number>(law.normal_damping)),
          shear_damping(all_of<Number>(law.shear_damping)),
          normal_damping_ratio_term(all_of<Number>(law.normal_damping_ratio_term)),
          shear_damping_ratio_term(all_of<Number>(law.shear_damping_ratio_term)),
          friction(all_of<Number>(law.friction)),
          break_overlap(all_of<Number>(law.break_overlap)),
          tensile_strength(all_of<Number>(law.tensile_strength)),
          cohesion(all_of<Number>(law.cohesion)),
          bond_friction(all_of<Number>(law.bond_friction)),
          has_shear_spring(law.shear_stiffness > 0.0) {
        follow_stiffness();
    }

    /// The same of points with these shares of its stiffness; damping terms go by Points::root_mass, which has them.
    CRACKLE_INLINE Law with_share(const Number& share) const {
        Law own = *this;
        own.normal_stiffness *= share;
        own.shear_stiffness *= share;
        own.follow_stiffness();
        return own;
    }

    /// The same with a shear stiffness of their own, too. @param root Points::shear_root
    CRACKLE_INLINE Law with_shares(const Number& share, const Number& root) const {
        Law own = with_share(share);
        own.shear_stiffness *= root * root;
        own.shear_damping_ratio_term *= root;
        return own;
    }

    CRACKLE_INLINE void follow_stiffness() {
        limit_stiffness = friction * normal_stiffness;
        half_stiffness = 0.5 * normal_stiffness;
    }

    Number normal_stiffness, shear_stiffness;                    // N/m
    Number normal_damping, shear_damping;                        // N s/m
    Number normal_damping_ratio_term, shear_damping_ratio_term;  // sqrt(N/m)
    Number friction, break_overlap;                              // -, m
    Number tensile_strength, cohesion, bond_friction;            // N, N, - : of BondLaw::coulomb
    Number limit_stiffness;                                      // N/m, Coulomb's limit over the overlap: μ k_n
    Number half_stiffness;                                       // N/m, ½k_n
    bool has_shear_spring;
};

/// Elastic normal force, N, of an overlap counted from no force.
template <class Number>
CRACKLE_INLINE Number spring_force(const Law<Number>& law, const Number& overlap) {
    return law.normal_stiffness * overlap;
}

/// Whether a bond holds at this overlap, m; else it breaks in this force pass (stepping/record_breaks.cpp records
/// that).
template <class Number>
CRACKLE_INLINE Condition<Number> bond_holds(const Law<Number>& law, const Number& overlap) {
    return overlap > law.break_overlap;
}

/// Whether a bonded point carries at least half its strength k_n δ0.
template <class Number>
CRACKLE_INLINE Condition<Number> carries_half_strength(const Law<Number>& law, const Number& normal,
                                                       const Number& shear, const Number& bond_overlap) {
    const Number half = law.half_stiffness * bond_overlap;
    return normal * normal + shear * shear >= half * half;
}

/// Strain energy of a point, counted from its bonded state. J.
inline double strain_energy(const ContactLaw& law, double overlap, double bond_overlap, double shear) {
    const double opening = overlap - bond_overlap;
    const double normal = 0.5 * law.normal_stiffness * opening * opening;
    return law.shear_stiffness > 0.0 ? normal + 0.5 * shear * shear / law.shear_stiffness : normal;
}

}  // namespace crackle
