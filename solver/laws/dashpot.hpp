// SPDX-License-Identifier: GPL-3.0-or-later
// Dashpots of a contact point: c_n dδ/dt along the normal, c_s du_t/dt along the tangent while the point sticks.
//
//     c = c_material + 2h sqrt(k m_eff)       N s/m, h damping ratio; the law stores 2h sqrt(k)
//
// Dashpots use the lagged velocity v(n-½). The normal dashpot may pull just before separation, as the restitution
// formula assumes. Without a shear spring, the shear dashpot alone resists slip, up to the Coulomb limit. The work of a
// dashpot over a drift is computed by the trapezoidal rule. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/laws/friction.hpp"

namespace crackle {

/// Normal damping c_n, N s/m. @param law a ContactLaw or Law @param root_mass the square root of the effective mass,
/// sqrt(kg)
template <class AnyLaw, class Number>
CRACKLE_INLINE Number normal_damping(const AnyLaw& law, const Number& root_mass) {
    return law.normal_damping + law.normal_damping_ratio_term * root_mass;
}
/// Shear damping c_s, N s/m; parameters as for normal_damping().
template <class AnyLaw, class Number>
CRACKLE_INLINE Number shear_damping(const AnyLaw& law, const Number& root_mass) {
    return law.shear_damping + law.shear_damping_ratio_term * root_mass;
}

/// Force of a point's shear dashpot, N, opposing the slip rate (m/s). @param slides whether the point slides, in which
/// case the force is 0
template <class Number>
CRACKLE_INLINE Number shear_dashpot(const Law<Number>& law, const Number& root_mass, const Number& slip_rate,
                                    const Number& overlap, const Condition<Number>& slides) {
    const Number force = shear_damping(law, root_mass) * slip_rate;
    if (law.has_shear_spring) return select(slides, Number{}, force);
    const Number limit = coulomb_limit(law, overlap);
    return select(slides, Number{}, select(magnitude(force) > limit, with_sign(limit, force), force));
}

/// Energy dissipated by both dashpots during a drift, J. @param normal the sum of the normal dashpot forces before and
/// after the drift, N @param shear the corresponding sum of the shear dashpot forces
template <class Number>
CRACKLE_INLINE Number dashpot_loss(double drift, const Number& normal, const Number& closing, const Number& shear,
                                   const Number& slip_rate) {
    return 0.5 * drift * (normal * closing + shear * slip_rate);
}

}  // namespace crackle
