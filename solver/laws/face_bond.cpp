// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/laws/face_bond.hpp"

#include <fmt/format.h>

#include "solver/base/errors.hpp"

namespace crackle {

FaceModuli face_moduli(double youngs_modulus, double poissons_ratio, double shear_ratio, double correction) {
    const double unlike = (1.0 - shear_ratio) / (1.0 + shear_ratio);
    const double r = 1.0 - correction * unlike * unlike;
    const double contact = 2.0 * youngs_modulus / ((1.0 + poissons_ratio) * (1.0 + shear_ratio) * r);
    const double pressure = 0.5 * youngs_modulus / (1.0 - poissons_ratio) - 0.5 * contact;
    constexpr double rounding = 1e-14;
    if (!(pressure >= -rounding * contact)) {
        // The smallest Poisson's ratio is that for which λ = 0; it follows from (1 - ν)/(1 + ν) = (1 + κ) r/2.
        const double half = 0.5 * (1.0 + shear_ratio) * r;
        throw InputError(
            fmt::format("faces: found a Poisson's ratio of {:.6g}, expected at least {:.6g} for k_t/k_n = "
                        "{:.6g}; raise Poisson's ratio or k_t/k_n",
                        poissons_ratio, (1.0 - half) / (1.0 + half), shear_ratio));
    }
    return {contact, std::max(0.0, pressure), shear_ratio};
}

FaceModuli face_moduli_without_pressure(double youngs_modulus, double poissons_ratio, double correction) {
    // λ = 0 means E_c = E/(1-ν). With y = (1-κ)/(1+κ), this becomes c_κ(1+ν)y² + (1-ν)y - 2ν = 0.
    const double b = 1.0 - poissons_ratio, c = 1.0 + poissons_ratio;
    const double unlike = 4.0 * poissons_ratio / (b + std::sqrt(b * b + 8.0 * correction * poissons_ratio * c));
    if (!(poissons_ratio >= 0.0 && unlike < 1.0))
        throw InputError(
            fmt::format("faces: found a Poisson's ratio of {:.6g}, expected a value >= 0 for which k_t > 0 (below 1/3 "
                        "without a mesh correction); for larger values, give stiffness_ratio, so that the pressure of "
                        "the cells produces Poisson's ratio",
                        poissons_ratio));
    return {youngs_modulus / b, 0.0, (1.0 - unlike) / (1.0 + unlike)};
}

void check_face_law(const FaceLaw& law) {
    const auto require = [](bool valid, const char* name, double found, const char* expected) {
        if (!valid) throw InputError(fmt::format("faces: {}: found {:.6g}, expected {}", name, found, expected));
    };
    constexpr double rounding = 1e-12;
    require(law.tensile_strength >= 0.0, "tensile strength", law.tensile_strength, "a stress >= 0");
    require(law.friction >= 0.0, "friction", law.friction, "a coefficient >= 0");
    require(law.cohesion >= 0.0, "cohesion", law.cohesion, "a stress >= 0");
    require(std::isinf(law.cohesion) || law.friction * law.tensile_strength <= law.cohesion * (1.0 + rounding),
            "cohesion", law.cohesion, "at least the tensile strength times the friction coefficient");
    const bool bent = std::isfinite(law.knee);
    require(law.knee >= 0.0, "knee of the envelope", law.knee, "a stress >= 0");
    require(!bent || (law.friction_beyond >= 0.0 && law.friction_beyond <= law.friction), "friction beyond the knee",
            law.friction_beyond, "a coefficient >= 0 that is at most the friction coefficient below the knee");
    require(law.moment_share >= 0.0 && law.moment_share <= 1.0, "moment share", law.moment_share,
            "a number from 0 to 1");
    require(law.residual_friction >= 0.0 && law.residual_friction <= (bent ? law.friction_beyond : law.friction),
            "residual friction", law.residual_friction,
            "a coefficient >= 0 that is at most the friction coefficient of intact faces");
    require(law.residual_cohesion >= 0.0 && law.residual_cohesion <= law.cohesion, "residual cohesion",
            law.residual_cohesion, "a stress >= 0 that is at most the cohesion");
    require(law.softening_slip >= 0.0, "softening slip", law.softening_slip, "a length >= 0");
    require(law.softening_slip == 0.0 || std::isfinite(law.cohesion), "cohesion", law.cohesion,
            "a finite stress, since slip reduces the cohesion");
    require(law.residual_tensile_strength >= 0.0 && law.residual_tensile_strength <= law.tensile_strength,
            "residual tensile strength", law.residual_tensile_strength,
            "a stress >= 0 that is at most the tensile strength");
    require(law.softening_opening >= 0.0, "softening opening", law.softening_opening, "a length >= 0");
    require(law.damping_ratio >= 0.0, "damping ratio", law.damping_ratio, "a number >= 0");
}

}  // namespace crackle
