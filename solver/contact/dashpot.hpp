// SPDX-License-Identifier: GPL-3.0-or-later
// Dashpots of a contact point: c_n dδ/dt along the normal, c_s du_t/dt along the tangent while the point sticks.
//
//     c = c_material + 2h sqrt(k m_eff)       N s/m, h the damping ratio (its term holds 2h sqrt(k))
//
// They see the lagged velocity v(n-½), and the normal one may pull just before separation, as the restitution formula
// assumes. Without a shear spring the shear dashpot is all that resists, and Coulomb's limit is its own. Energy: a
// dashpot's work over a drift by the trapezoidal rule. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/contact/friction.hpp"

namespace crackle {

/// c_n, N s/m. @param law ContactLaw or Law @param root_mass square root of the effective mass, sqrt(kg)
template <class AnyLaw, class Number>
CRACKLE_INLINE Number normal_damping(const AnyLaw& law, const Number& root_mass) {
    return law.normal_damping + law.normal_damping_ratio_term * root_mass;
}
/// c_s, N s/m.
template <class AnyLaw, class Number>
CRACKLE_INLINE Number shear_damping(const AnyLaw& law, const Number& root_mass) {
    return law.shear_damping + law.shear_damping_ratio_term * root_mass;
}

/// Shear dashpot of a point, N against the slip rate (m/s). @param slides whether it slides, so that nothing drags
template <class Number>
CRACKLE_INLINE Number shear_dashpot(const Law<Number>& law, const Number& root_mass, const Number& slip_rate,
                                    const Number& overlap, const Condition<Number>& slides) {
    const Number force = shear_damping(law, root_mass) * slip_rate;
    if (law.has_shear_spring) return select(slides, Number{}, force);
    const Number limit = coulomb_limit(law, overlap);
    return select(slides, Number{}, select(magnitude(force) > limit, with_sign(limit, force), force));
}

/// Work that both dashpots take over a drift, J. @param normal sum of the forces before and after it, N, likewise shear
template <class Number>
CRACKLE_INLINE Number dashpot_loss(double drift, const Number& normal, const Number& closing, const Number& shear,
                                   const Number& slip_rate) {
    return 0.5 * drift * (normal * closing + shear * slip_rate);
}

}  // namespace crackle
