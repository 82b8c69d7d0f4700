// SPDX-License-Identifier: GPL-3.0-or-later
// Bond with strengths of its own (BondLaw::coulomb): tension cut-off, cohesion and friction.
//
//     bonded       f_n = k_n(δ - δ0), f_t elastic, no slip; holds while  f_n > -T  and  |f_t| < C + μ f_n
//     afterwards   f_n = k_n max(0, δ - max(δ0, 0)),  |f_t| <= μ_r f_n
//
// T tensile strength, C cohesion, N; μ, μ_r friction of the bond and residual friction; f_n > 0 pushes. A pair keeps
// its rest overlap max(δ0, 0), or it would push with k_n δ0 after a break in shear: energy from nowhere. Of two limits
// exceeded in one step the mode is the one that the straight way of (f_n, f_t) meets first; at the apex μT = C it is
// tension. Energy of a break: in the trapezoidal account of a step (x' and x elongations δ - δ0 before and now, y what
// force is left of over k_n; likewise shear with the spring's force over k_s)
//     ½k_n(x' + y)(x - y) + ½(f_t' + h)(f_t - h)/k_s   ->   strain energy before less that after, >= 0, as Δt -> 0,
// a term below 0 being nothing: its force turned within the step and has passed through none.
// Source: solver/MODEL.md 5.2; verified by tests/solver/contact/coulomb_bond_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/friction.hpp"

namespace crackle {

/// Strengths of a bond with its own share.
template <class Number>
struct BondStrength {
    Number tensile, cohesion;  // N
    Number friction;           // μ
};

template <class Number>
CRACKLE_INLINE Condition<Number> fails_in_tension(const BondStrength<Number>& strength, const Number& normal) {
    return normal <= -strength.tensile;
}

template <class Number>
CRACKLE_INLINE Condition<Number> fails_in_shear(const BondStrength<Number>& strength, const Number& normal,
                                                const Number& shear) {
    return magnitude(shear) >= strength.cohesion + strength.friction * normal;
}

/// Elastic forces of a bonded point, N: normal, compression positive, and shear.
struct BondForces {
    double normal, shear;
};

/// Where on the straight way from `before` to `now` a limit is met, as a share of it; infinite if not.
inline double share_to_limit(double slack_before, double slack_now) {
    if (slack_now > 0.0) return std::numeric_limits<double>::infinity();
    return slack_before > slack_now ? std::max(0.0, slack_before / (slack_before - slack_now)) : 0.0;
}

/// Whether the limit of shear is met before that of tension. @param before within both limits, or nearly so
inline bool shear_comes_first(const BondStrength<double>& s, const BondForces& before, const BondForces& now) {
    const auto shear_slack = [&](const BondForces& f) {
        return s.cohesion + s.friction * f.normal - std::abs(f.shear);
    };
    return share_to_limit(shear_slack(before), shear_slack(now)) <
           share_to_limit(s.tensile + before.normal, s.tensile + now.normal);
}

/// What a break leaves of a bond, and what it takes.
struct BrokenBond {
    bool in_shear;
    double rest_overlap;   // m, max(δ0, 0)
    double normal, shear;  // N, elastic forces left
    double strength;       // N: T, or C + μ f_n where it failed in shear
    double energy;         // J
};

/// @param law of the point, μ_r in it @param opening δ - δ0 now, m @param bond_overlap δ0, m
inline BrokenBond break_bond(const Law<double>& law, const BondStrength<double>& strength, const BondForces& before,
                             const BondForces& now, double opening, double bond_overlap) {
    BrokenBond broken{};
    broken.in_shear = shear_comes_first(strength, before, now);
    broken.rest_overlap = std::max(bond_overlap, 0.0);
    const double left = std::max(0.0, opening + bond_overlap - broken.rest_overlap);  // m
    broken.normal = spring_force(law, left);
    const ShearTrial<double> trial{before.shear, now.shear, law.friction * broken.normal,
                                   std::abs(now.shear) > law.friction * broken.normal};
    broken.shear = shear_force(trial);
    broken.strength = broken.in_shear ? strength.cohesion + strength.friction * now.normal : strength.tensile;
    broken.energy = std::max(0.0, 0.5 * (before.normal + broken.normal) * (opening - left)) +
                    std::max(0.0, slider_loss(law, trial, broken.shear));
    return broken;
}

}  // namespace crackle
