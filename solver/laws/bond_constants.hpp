// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of bonds that users give, under the same names in scenes, in cases and for change_law(). The header of each
// bond law lists its constants. The code that reads, checks or changes constants goes through this list.
// Tested by tests/solver/laws/bond_law_test.cpp.
#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "solver/base/correctly_rounded.hpp"
#include "solver/laws/contact_law.hpp"

namespace crackle {

/// Constants of bonds; each is empty if it is not given.
struct BondConstants {
    std::optional<double> tensile_strength;         ///< T, N, or Pa with StiffnessUnits::area
    std::optional<double> cohesion;                 ///< C, N, or Pa
    std::optional<double> residual_friction_angle;  ///< degrees, for contacts without a bond

    friend bool operator==(const BondConstants&, const BondConstants&) = default;
};

/// μ = tan φ. @param angle the friction angle φ, degrees
inline double friction_coefficient(double angle) { return correctly_rounded::tan(angle * std::numbers::pi / 180.0); }

/// A constant in the list of a bond law.
struct BondConstant {
    const char* key;  ///< name of the member, used as the key in input files
    std::optional<double> BondConstants::*given;
    double ContactLaw::*of_law;  ///< member of ContactLaw that holds the result of in_law()
    bool is_angle;               ///< true: degrees, from 0 to the friction angle; false: a strength, N or Pa, >= 0
    const char* meaning;         ///< description for users, one or two sentences

    /// Value as the law uses it: an angle is converted to a friction coefficient, a strength is unchanged.
    double in_law(double value) const { return is_angle ? friction_coefficient(value) : value; }
    /// The key in words, for messages: "tensile strength".
    std::string spoken() const {
        std::string words = key;
        std::ranges::replace(words, '_', ' ');
        return words;
    }
};

/// Whether a tensile strength exceeds C/μ, the apex of the failure envelope, so that tension could never reach it.
inline bool beyond_apex(double friction, double tensile_strength, double cohesion) {
    constexpr double rounding = 1e-12;
    return friction * tensile_strength > cohesion * (1.0 + rounding);
}

}  // namespace crackle
