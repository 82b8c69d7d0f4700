// SPDX-License-Identifier: GPL-3.0-or-later
// Law of a face between two bonded polygons: a rigid-body spring network in which each cell also has a pressure.
//
// Stiffness of a face of length L whose two reference points are a distance h apart along its normal, with κ = k_t/k_n.
// The formulas are for plane stress; for plane strain, E/(1-ν²) and ν/(1-ν) replace E and ν:
//     r = 1 - c_κ ((1-κ)/(1+κ))²     E_c = 2E/((1+ν)(1+κ) r)     λ = E/(2(1-ν)) - E_c/2
//     k_n = E_c L/h     k_t = κ k_n     k_φ = k_n L²/12
// E_c is the contact modulus and λ the pressure modulus, Pa. A cell with dilation e has the pressure p = λ e. The areal
// modulus E_c/2 + λ is exact for every κ. The factor c_κ corrects the shear modulus of irregular cells, which would be
// too low for κ ≠ 1. λ >= 0 is required, since irregular cells would otherwise have modes of negative energy. With λ =
// 0, κ follows from ν.
//
// Conditions for the failure of an intact face. s = -F_n/L is the compressive stress; T and C include the same random
// factor:
//     tension   F_n/L + 6β|M|/L² > T
//     shear     |F_t|/L > C + s tan φ     up to s = s_b; beyond: C + s_b tan φ + (s - s_b) tan φ₂
// If both conditions hold, the mode is the one whose stress is the larger multiple of its strength. The law requires T
// tan φ <= C, φ₂ <= φ, s_b >= 0 and φ_r <= φ₂. Otherwise the residual strength could exceed the peak strength.
//
// After failure, the two edges press on each other over their lap, the length over which they lie opposite each other.
// The pressure is linear in the overlap, without tension. 2a is the lap, d the opening at its centre, δ_φ the relative
// rotation, φ = |δ_φ|, and k = k_n/L the normal stiffness per length:
//     d + aφ <= 0    F = 2a k d,  M = k (2a)³/12 δ_φ,           Ψ = ½(2a k d² + k (2a)³/12 δ_φ²)
//     d - aφ >= 0    no contact
//     otherwise      b = a - d/φ,  F = -½ k φ b²,  |M| = |F|(a - b/3),  Ψ = k φ² b³/6,  M with the sign of δ_φ
// Tension is positive. The shear force is limited to c(u) b_c + max(0, -F) tan φ_r. b_c is the smallest closed length
// (over which the edges press) since failure. The cohesion c(u) falls from C to c_r over the slip u_c, and equals c_r
// if u_c = 0. After a failure in shear, the edges also carry tension where they do not press: 1 - D times the tension
// of the intact face. Let σ = F/2a + 6β|M|/(2a)² be the stress without damage. For σ > σ_r, D is the largest value so
// far of (1 - σ_r/σ)/(1 - σ_r/(k w_c)). The tension thus falls from σ_r to 0 over the inelastic opening w_c, and
// immediately if w_c <= σ_r/k. All forces are per metre of thickness. Source: solver/MODEL.md 5.5. Tested by
// tests/solver/laws/face_bond_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/fields.hpp"
#include "solver/base/lanes.hpp"
#include "solver/laws/bond_law.hpp"
#include "solver/laws/coulomb_bond.hpp"

namespace crackle {

/// Describes bonds by faces as one of the bond laws of scenes and cases. Users give the strengths of a coulomb bond,
/// and further constants (FaceConstants).
struct FaceBond {
    static constexpr BondLaw law = BondLaw::face;
    static constexpr BondLawFacts facts = [] {
        BondLawFacts own = CoulombBond::facts;
        own.meaning = "each face between two polygons has normal, shear and moment springs and breaks as a whole";
        own.by_faces = true;
        return own;
    }();
};

/// Moduli of rock whose cells are bonded by faces, Pa.
struct FaceModuli {
    double contact = 0.0;      ///< E_c: normal stress per unit of strain between the two reference points
    double pressure = 0.0;     ///< λ: pressure of a cell per unit of dilation; 0 if cells have no pressure
    double shear_ratio = 1.0;  ///< κ = k_t/k_n
};

/// Moduli for a given ratio of shear to normal stiffness; the pressure of the cells produces Poisson's ratio. @param
/// correction c_κ
/// @throws InputError if the pressure modulus would be negative
FaceModuli face_moduli(double youngs_modulus, double poissons_ratio, double shear_ratio, double correction);

/// Moduli for cells without pressure; the ratio of shear to normal stiffness follows from Poisson's ratio. @param
/// correction c_κ
/// @throws InputError if Poisson's ratio is negative, or so large that k_t would not be positive (1/3 if c_κ is 0)
FaceModuli face_moduli_without_pressure(double youngs_modulus, double poissons_ratio, double correction);

/// Strengths of the faces between two materials; with the default values a face never breaks.
struct FaceLaw {
    double tensile_strength = std::numeric_limits<double>::infinity();  // T, Pa
    double cohesion = std::numeric_limits<double>::infinity();          // C, Pa
    double friction = 0.0;                                              // tan φ
    double knee = std::numeric_limits<double>::infinity();              // s_b, Pa
    double friction_beyond = 0.0;                                       // tan φ₂
    double moment_share = 0.0;                                          // β, 0 to 1
    double residual_friction = 0.0;                                     // tan φ_r
    double residual_cohesion = 0.0;                                     // c_r, Pa
    double softening_slip = 0.0;                                        // u_c, m
    double residual_tensile_strength = 0.0;                             // σ_r, Pa
    double softening_opening = 0.0;                                     // w_c, m
    double damping_ratio = 0.0;                                         // h, the same for all springs of a face

    /// Whether a face of this law can break.
    bool can_break() const { return std::isfinite(tensile_strength) || std::isfinite(cohesion); }

    CRACKLE_FIELDS(tensile_strength, cohesion, friction, knee, friction_beyond, moment_share, residual_friction,
                   residual_cohesion, softening_slip, residual_tensile_strength, softening_opening, damping_ratio);
};

/// Checks a law. @throws InputError if a value is out of its range, or if the residual strength could exceed the peak
/// strength
void check_face_law(const FaceLaw& law);

/// Forces of a face on body i: F_n along the normal (tension positive), F_t along the tangent, and the moment M.
struct FaceForces {
    double normal = 0.0, shear = 0.0;  // N
    double moment = 0.0;               // N m
};

/// Whether a face fails, and in which mode.
enum class FaceFailure { none, tension, shear };

/// Strengths of an intact face, or of one face per lane.
template <class Number>
struct FaceStrength {
    FaceStrength() = default;
    /// @param share random factor on T and C
    CRACKLE_INLINE FaceStrength(const FaceLaw& law, const Number& share)
        : tensile(share * law.tensile_strength),
          cohesion(share * law.cohesion),
          friction(all_of<Number>(law.friction)),
          knee(all_of<Number>(law.knee)),
          friction_beyond(all_of<Number>(law.friction_beyond)),
          moment_share(all_of<Number>(law.moment_share)) {}

    Number tensile, cohesion, friction, knee, friction_beyond, moment_share;
};

/// Tensile and shear stress of an intact face, and its shear strength at the present compression, Pa.
template <class Number>
struct FaceStress {
    /// @param normal, tangential, moment F_n (N), F_t (N) and M (N m) of the face
    CRACKLE_INLINE FaceStress(const FaceStrength<Number>& strength, const Number& length, const Number& normal,
                              const Number& tangential, const Number& moment)
        : tension(normal / length + 6.0 * strength.moment_share * magnitude(moment) / (length * length)),
          shear(magnitude(tangential) / length) {
        const Number compression = -normal / length, beyond = compression - strength.knee;
        shear_strength = strength.cohesion + strength.friction * select(beyond < 0.0, compression, strength.knee) +
                         strength.friction_beyond * select(beyond < 0.0, Number{}, beyond);
    }

    Number tension, shear, shear_strength;
};

/// Failure mode of an intact face under given forces. @param length L, m @param share random factor on the strengths
inline FaceFailure face_failure(const FaceLaw& law, double length, double share, const FaceForces& f) {
    const FaceStrength<double> strength(law, share);
    const FaceStress<double> stress(strength, length, f.normal, f.shear, f.moment);
    const bool parts = stress.tension > strength.tensile, slips = stress.shear > stress.shear_strength;
    if (!parts && !slips) return FaceFailure::none;
    // The mode with the larger ratio of stress to strength is chosen. The ratios are compared without division, since a
    // strength may be 0.
    if (parts && (!slips || stress.tension * std::max(0.0, stress.shear_strength) >= stress.shear * strength.tensile))
        return FaceFailure::tension;
    return FaceFailure::shear;
}

/// Factor by which given forces must be multiplied so that an intact face fails; infinite if it never fails. @param
/// length L, m @param share random factor on the strengths
inline double face_failure_load(const FaceLaw& law, double length, double share, const FaceForces& f) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const FaceStrength<double> strength(law, share);
    const double tension = f.normal / length + 6.0 * strength.moment_share * std::abs(f.moment) / (length * length);
    const double shear = std::abs(f.shear) / length, compression = -f.normal / length;
    const double parts = tension > 0.0 ? strength.tensile / tension : infinite;
    const auto slips = [&](double cohesion, double friction) {
        const double rise = shear - friction * compression;
        return rise > 0.0 ? cohesion / rise : infinite;
    };
    double slides = slips(strength.cohesion, strength.friction);
    if (compression > 0.0 && slides * compression > strength.knee) {
        // Beyond the knee, the second line of the envelope applies.
        slides = slips(strength.cohesion + (strength.friction - strength.friction_beyond) * strength.knee,
                       strength.friction_beyond);
    }
    return std::min(parts, slides);
}

/// Force, moment and energy of the pressure between two edges.
struct LapPressure {
    double force = 0.0;   // F, N
    double moment = 0.0;  // M about the centre of the lap, N m
    double energy = 0.0;  // Ψ, J
    double closed = 0.0;  // m, length over which the edges press; equal to (dF/dd)/k

    CRACKLE_FIELDS(force, moment, energy, closed);
};

/// Linear pressure between two edges, without tension. @param stiffness k, N/m per metre of length @param half_lap a, m
/// @param opening d, m @param turn δ_φ, rad
inline LapPressure lap_pressure(double stiffness, double half_lap, double opening, double turn) {
    const double a = half_lap, d = opening, phi = std::abs(turn);
    if (a <= 0.0 || d - a * phi >= 0.0) return {};
    if (d + a * phi <= 0.0) {
        const double k_n = 2.0 * a * stiffness, k_phi = k_n * a * a / 3.0;
        return {k_n * d, k_phi * turn, 0.5 * (k_n * d * d + k_phi * turn * turn), 2.0 * a};
    }
    const double b = a - d / phi, force = -0.5 * stiffness * phi * b * b;
    return {force, std::copysign(-force * (a - b / 3.0), turn), stiffness * phi * phi * b * b * b / 6.0, b};
}

/// Tension between two undamaged edges where they do not press on each other. Parameters as for lap_pressure().
inline LapPressure lap_tension(double stiffness, double half_lap, double opening, double turn) {
    const LapPressure push = lap_pressure(stiffness, half_lap, opening, turn);
    const double k_n = 2.0 * half_lap * stiffness, k_phi = k_n * half_lap * half_lap / 3.0;
    return {k_n * opening - push.force, k_phi * turn - push.moment,
            0.5 * (k_n * opening * opening + k_phi * turn * turn) - push.energy, 2.0 * half_lap - push.closed};
}

/// The factor 1 - D on the tension of a face that failed in shear. @param held previous value of 1 - D @param stiffness
/// k, Pa/m @param stress σ, Pa
/// @param share random factor on T
inline double tension_held(const FaceLaw& law, double held, double stiffness, double stress, double share) {
    const double residual = std::min(law.residual_tensile_strength, share * law.tensile_strength);
    if (stress <= residual) return held;
    // This is -infinity if softening_opening is 0, or NaN if the residual strength is also 0.
    const double steepness = 1.0 - residual / (stiffness * law.softening_opening);
    if (!(steepness > 0.0)) return 0.0;
    return std::min(held, std::max(0.0, 1.0 - (1.0 - residual / stress) / steepness));
}

/// Residual cohesion of a face, at most its initial cohesion, Pa. @param share random factor on C
inline double residual_cohesion_of(const FaceLaw& law, double share) {
    return std::min(law.residual_cohesion, share * law.cohesion);
}

/// Remaining cohesion after a given slip, Pa. @param slipped Σ|Δu_p|, m @param share random factor on C
inline double cohesion_left(const FaceLaw& law, double slipped, double share) {
    const double residual = residual_cohesion_of(law, share);
    if (!(slipped < law.softening_slip)) return residual;
    return residual + (share * law.cohesion - residual) * (1.0 - slipped / law.softening_slip);
}

/// Shear force of a broken face and its plastic slip in this step.
struct FaceSlip {
    double force = 0.0;        // N
    double slip = 0.0;         // m, Δu_p
    double of_fracture = 0.0;  // N, part of the force that works against cohesion above its residual value
};

/// Computes the slip that reduces a trial shear force to the limit c(u) b_c + max(0, -F) tan φ_r. The slip in this step
/// also reduces the limit.
/// @param trial k_t(δ_t - u_p) + L τ, N @param stiffness k_t, N/m @param pressing max(0, -F), N @param glued b_c, m
inline FaceSlip slip_of_face(const FaceLaw& law, double trial, double stiffness, double pressing, double glued,
                             double slipped, double share) {
    const double rubbing = law.residual_friction * pressing, size = std::abs(trial);
    const double before = cohesion_left(law, slipped, share), residual = residual_cohesion_of(law, share);
    if (size <= rubbing + before * glued) return {trial, 0.0, 0.0};
    double slip = (size - rubbing - before * glued) / stiffness;
    if (slipped < law.softening_slip && glued > 0.0) {
        const double slope = (share * law.cohesion - residual) / law.softening_slip * glued;
        const double longer =
            slope < stiffness ? slip * stiffness / (stiffness - slope) : std::numeric_limits<double>::infinity();
        // Beyond the softening slip, the cohesion has its residual value.
        slip = slipped + longer < law.softening_slip ? longer : (size - rubbing - residual * glued) / stiffness;
    }
    const double after = cohesion_left(law, slipped + slip, share);
    const double left = rubbing + after * glued;
    return {std::copysign(left, trial), std::copysign(slip, trial), (0.5 * (before + after) - residual) * glued};
}

}  // namespace crackle
