// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of bonds that users give, with the same name in scenes, in cases and for change_law(). The header of a bond
// law lists those that it has; whatever reads, checks or changes them walks that list.
// Tested by tests/solver/laws/bond_law_test.cpp.
#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "solver/base/correctly_rounded.hpp"
#include "solver/laws/contact_law.hpp"

namespace crackle {

/// Constants of bonds; empty where they are not given.
struct BondConstants {
    std::optional<double> tensile_strength;         ///< T, N, or Pa with StiffnessUnits::area
    std::optional<double> cohesion;                 ///< C, N, or Pa
    std::optional<double> residual_friction_angle;  ///< degrees, of contacts without a bond

    friend bool operator==(const BondConstants&, const BondConstants&) = default;
};

/// μ = tan φ. @param angle the friction angle φ, degrees
inline double friction_coefficient(double angle) { return correctly_rounded::tan(angle * std::numbers::pi / 180.0); }

/// A constant, as a bond law lists it.
struct BondConstant {
    const char* key;  ///< as a member is named, and as users write it
    std::optional<double> BondConstants::*given;
    double ContactLaw::*of_law;  ///< the same in laws of contacts, as in_law() converts it
    bool is_angle;               ///< degrees, from 0 to the friction angle; otherwise a strength, N or Pa, >= 0
    const char* meaning;         ///< a sentence or two

    /// The value that the law uses: a strength is unchanged; an angle is converted to its friction coefficient.
    double in_law(double value) const { return is_angle ? friction_coefficient(value) : value; }
    /// Its name as words of a sentence.
    std::string spoken() const {
        std::string words = key;
        std::ranges::replace(words, '_', ' ');
        return words;
    }
};

/// Whether a tensile strength lies beyond the apex of the failure envelope, C/μ, which would then never reach it.
inline bool beyond_apex(double friction, double tensile_strength, double cohesion) {
    constexpr double rounding = 1e-12;
    return friction * tensile_strength > cohesion * (1.0 + rounding);
}

}  // namespace crackle
