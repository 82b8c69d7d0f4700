// SPDX-License-Identifier: GPL-3.0-or-later
// Force of one contact point: linear springs, dashpots, Coulomb limit, back-tension.
//
//     f_n = k_n(δ - δ0) + c_n dδ/dt          positive pushes apart; back-tension f_b = -k_n δ0 while bonded
//     f_t ← f_t - k_s Δu_t, |f_t| <= μ k_n δ  elastic part; plus the dashpot -c_s du_t/dt while not sliding
//                                             (at most μ k_n δ where k_s = 0, for no spring would ever slide there)
//
// δ overlap [m], δ0 overlap at bonding (0: not bonded), u_t displacement of i against j along the normal turned by +90
// degrees. The limit uses the contact's own compression k_n δ, so a bond keeps the shear strength it had before
// bonding. The dashpot sees the lagged velocity v(n-½) and may pull just before separation, as the restitution formula
// assumes. Energy: the slider takes ½(f_t0 + f_t1)(trial - f_t1)/k_s a step, which together with ½f_t²/k_s is exactly
// the work of the mean shear force. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/world/world.hpp"

namespace crackle {

/// c_n = c + 2h sqrt(k_n m_eff), N s/m.
inline double normal_damping(const ContactLaw& law, double root_effective_mass) {
    return law.normal_damping + law.normal_damping_ratio_term * root_effective_mass;
}
inline double shear_damping(const ContactLaw& law, double root_effective_mass) {
    return law.shear_damping + law.shear_damping_ratio_term * root_effective_mass;
}

struct ShearUpdate {
    double force;     // N, elastic part after the step
    double friction;  // J taken by the slider
    bool sliding;
};

/// Incremental shear spring with Coulomb limit. @param slip displacement of i against j in this step, m.
inline ShearUpdate shear_force(const ContactLaw& law, double before, double slip, double overlap) {
    const double trial = before - law.shear_stiffness * slip;
    const double limit = law.friction * law.normal_stiffness * std::max(overlap, 0.0);
    // Written so that μ = ∞ (sliding switched off) sticks at δ <= 0 too, where ∞·0 is not a number.
    // Without resistance a point slides even if its spring is not strained, or its dashpot would drag.
    if (!(std::abs(trial) > limit) && !(limit <= 0.0)) return {trial, 0.0, false};
    const double force = std::copysign(limit, trial);
    const double friction =
        law.shear_stiffness > 0.0 ? 0.5 * (before + force) * (trial - force) / law.shear_stiffness : 0.0;
    return {force, friction, true};
}

/// Shear dashpot of a point that sticks, N against `slip_rate` (m/s). Without a shear spring it is all that resists,
/// and Coulomb's limit is its own.
inline double shear_dashpot(const ContactLaw& law, double root_effective_mass, double slip_rate, double overlap) {
    const double force = shear_damping(law, root_effective_mass) * slip_rate;
    if (law.shear_stiffness > 0.0) return force;
    const double limit = law.friction * law.normal_stiffness * std::max(overlap, 0.0);
    return std::abs(force) > limit ? std::copysign(limit, force) : force;
}

/// Strain energy of a point, counted from its bonded state. J.
inline double strain_energy(const ContactLaw& law, double overlap, double bond_overlap, double shear) {
    const double opening = overlap - bond_overlap;
    const double normal = 0.5 * law.normal_stiffness * opening * opening;
    return law.shear_stiffness > 0.0 ? normal + 0.5 * shear * shear / law.shear_stiffness : normal;
}

}  // namespace crackle
