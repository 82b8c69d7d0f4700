// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a contact point: incremental shear spring with a Coulomb limit.
//
//     trial = f_t - k_s Δu_t       f_t ← trial, or ±limit if |trial| > limit
//
// The limit is μ k_n max(δ, 0) in a world without bonds, and in one with back-tension bonds, which do not change the
// shear strength. In any world with bonds, shear_limit() of the bond law returns it. Energy: the slider dissipates
// ½(f_t0 + f_t1)(trial - f_t1)/k_s per step. Together with the change of ½f_t²/k_s this is exactly the work of the mean
// shear force. Faces slide by slip_of_face() of face_bond.hpp. Forces in N. Source: DEMseg guide; solver/MODEL.md 4.
#pragma once

#include "solver/laws/law.hpp"

namespace crackle {

/// Coulomb limit at a given overlap: the largest shear force that a point can carry, N.
template <class Number>
CRACKLE_INLINE Number coulomb_limit(const Law<Number>& law, const Number& overlap) {
    return law.limit_stiffness * select(overlap < 0.0, Number{}, overlap);
}

/// Shear force of a point computed as if it did not slide, and whether the point slides.
template <class Number>
struct ShearTrial {
    Number before, force;  // N, shear force at the beginning of the step, and at its end without sliding
    Number limit;          // N
    Condition<Number> slides;
};

/// Computes the trial shear force for a given Coulomb limit. @param slip the displacement of i relative to j in this
/// step, m @param limit the limit, N
template <class Number>
CRACKLE_INLINE ShearTrial<Number> try_shear_within(const Law<Number>& law, const Number& before, const Number& slip,
                                                   const Number& limit) {
    ShearTrial<Number> trial;
    trial.before = before;
    trial.force = before - law.shear_stiffness * slip;
    trial.limit = limit;
    // In this form the point also sticks for μ = ∞ (sliding switched off) with δ <= 0, where ∞·0 is NaN. A point with a
    // limit of 0 slides even if its spring is unstrained; otherwise its dashpot would act.
    trial.slides = (magnitude(trial.force) > trial.limit) | (trial.limit <= 0.0);
    return trial;
}

/// Computes the trial shear force for the Coulomb limit at an overlap. @param slip the displacement of i relative to j
/// in this step, m
template <class Number>
CRACKLE_INLINE ShearTrial<Number> try_shear(const Law<Number>& law, const Number& before, const Number& slip,
                                            const Number& overlap) {
    return try_shear_within(law, before, slip, coulomb_limit(law, overlap));
}

/// Force of the shear spring after the step, N.
template <class Number>
CRACKLE_INLINE Number shear_force(const ShearTrial<Number>& trial) {
    return select(trial.slides, with_sign(trial.limit, trial.force), trial.force);
}

/// Energy dissipated by the friction of a sliding point, J. @param force the shear force after the step, N
template <class Number>
CRACKLE_INLINE Number slider_loss(const Law<Number>& law, const ShearTrial<Number>& trial, const Number& force) {
    if (!law.has_shear_spring) return Number{};
    return 0.5 * (trial.before + force) * (trial.force - force) / law.shear_stiffness;
}

}  // namespace crackle
