// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a contact point: incremental shear spring under Coulomb's limit.
//
//     trial = f_t - k_s Δu_t       limit = μ k_n max(δ, 0)       f_t ← trial, or the limit with its sign beyond it
//
// The limit uses the contact's own compression k_n δ, so that a bond keeps the shear strength it had before bonding.
// Energy: the slider takes ½(f_t0 + f_t1)(trial - f_t1)/k_s a step, which together with ½f_t²/k_s is exactly the work
// of the mean shear force. Forces in N. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/contact/law.hpp"

namespace crackle {

/// Largest shear force at an overlap, N.
template <class Number>
CRACKLE_INLINE Number coulomb_limit(const Law<Number>& law, const Number& overlap) {
    return law.limit_stiffness * select(overlap < 0.0, Number{}, overlap);
}

/// The shear spring after a step, if nothing slid, and whether it slides.
template <class Number>
struct ShearTrial {
    Number before, force;  // N, at the begin and at the end of the step
    Number limit;          // N
    Condition<Number> slides;
};

/// @param slip displacement of i against j in this step, m @param limit N
template <class Number>
CRACKLE_INLINE ShearTrial<Number> try_shear_within(const Law<Number>& law, const Number& before, const Number& slip,
                                                   const Number& limit) {
    ShearTrial<Number> trial;
    trial.before = before;
    trial.force = before - law.shear_stiffness * slip;
    trial.limit = limit;
    // Written so that μ = ∞ (sliding switched off) sticks at δ <= 0 too, where ∞·0 is not a number.
    // Without resistance a point slides even if its spring is not strained, or its dashpot would drag.
    trial.slides = (magnitude(trial.force) > trial.limit) | (trial.limit <= 0.0);
    return trial;
}

/// @param slip displacement of i against j in this step, m
template <class Number>
CRACKLE_INLINE ShearTrial<Number> try_shear(const Law<Number>& law, const Number& before, const Number& slip,
                                            const Number& overlap) {
    return try_shear_within(law, before, slip, coulomb_limit(law, overlap));
}

/// The shear spring after the step, N.
template <class Number>
CRACKLE_INLINE Number shear_force(const ShearTrial<Number>& trial) {
    return select(trial.slides, with_sign(trial.limit, trial.force), trial.force);
}

/// What the slider of a point that slides takes, J. @param force after the step, N
template <class Number>
CRACKLE_INLINE Number slider_loss(const Law<Number>& law, const ShearTrial<Number>& trial, const Number& force) {
    if (!law.has_shear_spring) return Number{};
    return 0.5 * (trial.before + force) * (trial.force - force) / law.shear_stiffness;
}

}  // namespace crackle
