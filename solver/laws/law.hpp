// SPDX-License-Identifier: GPL-3.0-or-later
// Force of one contact point: linear springs, dashpots, Coulomb limit, back-tension.
//
//     f_n = k_n(δ - δ0) + c_n dδ/dt          positive pushes apart; back-tension f_b = -k_n δ0 while bonded
//     f_t ← f_t - k_s Δu_t, |f_t| <= μ k_n δ  elastic part (friction.hpp); plus the dashpot -c_s du_t/dt while not
//                                             sliding (dashpot.hpp)
//
// δ overlap [m], δ0 overlap at bonding (0: not bonded), u_t displacement of i relative to j along the normal turned by
// +90 degrees. The law is written once for any Number: a double, or Lanes for several points. This file contains its
// constants and the normal spring. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/base/lanes.hpp"
#include "solver/laws/contact_law.hpp"

namespace crackle {

/// Constants of a ContactLaw, copied to all lanes of a Number, and values derived from them.
template <class Number>
struct Law {
    Law() = default;
    /// @param law the constants of a pair of materials
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

    /// The law with its stiffnesses multiplied by a factor. Damping terms are unchanged, since Points::root_mass
    /// already contains the factor.
    CRACKLE_INLINE Law with_share(const Number& share) const {
        Law own = *this;
        own.normal_stiffness *= share;
        own.shear_stiffness *= share;
        own.follow_stiffness();
        return own;
    }

    /// The law with a stiffness factor and an additional shear stiffness factor. @param root the square root of the
    /// additional factor, Points::shear_root
    CRACKLE_INLINE Law with_shares(const Number& share, const Number& root) const {
        Law own = with_share(share);
        own.shear_stiffness *= root * root;
        own.shear_damping_ratio_term *= root;
        return own;
    }

    /// Recomputes the values derived from the normal stiffness.
    CRACKLE_INLINE void follow_stiffness() {
        limit_stiffness = friction * normal_stiffness;
        half_stiffness = 0.5 * normal_stiffness;
    }

    Number normal_stiffness, shear_stiffness;                    // N/m
    Number normal_damping, shear_damping;                        // N s/m
    Number normal_damping_ratio_term, shear_damping_ratio_term;  // sqrt(N/m)
    Number friction, break_overlap;                              // -, m
    Number tensile_strength, cohesion, bond_friction;            // N, N and -; if strengths_are_given
    Number limit_stiffness;  // N/m, slope of the Coulomb limit as a function of overlap: μ k_n
    Number half_stiffness;   // N/m, ½k_n
    bool has_shear_spring;
};

/// Elastic normal force, N. @param overlap the overlap minus the overlap at which the force is zero, m
template <class Number>
CRACKLE_INLINE Number spring_force(const Law<Number>& law, const Number& overlap) {
    return law.normal_stiffness * overlap;
}

/// Normal spring of a contact, without a bond's back-tension.
template <class Number>
struct ContactSpring {
    Number force;        // N
    Number compression;  // m, determines the Coulomb limit
};
/// @param overlap of the two surfaces, m
template <class Number>
CRACKLE_INLINE ContactSpring<Number> contact_spring(const Law<Number>& law, const Number& overlap) {
    return {spring_force(law, overlap), overlap};
}

/// Strain energy of a point relative to its bonded state, J.
inline double strain_energy(const ContactLaw& law, double overlap, double bond_overlap, double shear) {
    const double opening = overlap - bond_overlap;
    const double normal = 0.5 * law.normal_stiffness * opening * opening;
    return law.shear_stiffness > 0.0 ? normal + 0.5 * shear * shear / law.shear_stiffness : normal;
}

}  // namespace crackle
