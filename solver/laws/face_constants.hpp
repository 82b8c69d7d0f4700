// SPDX-License-Identifier: GPL-3.0-or-later
// Constants that users give for rock whose cells are bonded by faces, in addition to the strengths in
// bond_constants.hpp. The code that reads, checks and documents the keys of a case uses the list face_constants.
// Tested by tests/solver/laws/face_bond_test.cpp.
#pragma once

#include <optional>

namespace crackle {

/// Constants of faces; each is empty if it is not given.
struct FaceConstants {
    std::optional<double> youngs_modulus;             ///< E, Pa
    std::optional<double> poissons_ratio;             ///< ν
    std::optional<double> moment_share;               ///< β
    std::optional<double> friction_knee;              ///< s_b, Pa
    std::optional<double> friction_angle_beyond;      ///< φ₂, degrees
    std::optional<double> residual_cohesion;          ///< c_r, Pa
    std::optional<double> softening_slip;             ///< u_c, m
    std::optional<double> residual_tensile_strength;  ///< σ_r, Pa
    std::optional<double> softening_opening;          ///< w_c, m

    friend bool operator==(const FaceConstants&, const FaceConstants&) = default;
};

/// Key, unit, limit and meaning of one constant of faces.
struct FaceConstant {
    const char* key;  ///< name of the member, used as the key in input files
    const char* unit;
    std::optional<double> FaceConstants::*given;
    double below;         ///< values must be less than this
    const char* meaning;  ///< description for users, one or two sentences
};

/// All constants of faces; all values are >= 0.
inline constexpr FaceConstant face_constants[]{
    {"youngs_modulus", "Pa", &FaceConstants::youngs_modulus, 1e300,
     "Young's modulus of the rock; with bond.law = \"face\", it replaces contact_modulus."},
    {"poissons_ratio", "", &FaceConstants::poissons_ratio, 1.0,
     "Poisson's ratio of the rock in plane stress, with bond.law = \"face\". If stiffness_ratio is given, the "
     "pressure of the cells produces "
     "Poisson's ratio. Otherwise "
     "stiffness_ratio is computed from it, "
     "which is always possible for values "
     "below 1/3."},
    {"moment_share", "", &FaceConstants::moment_share, 1.0 + 1e-12,
     "Fraction (0 to 1) of the bending stress of a face that is added to its tensile stress, with bond.law = "
     "\"face\"; 0 if not given."},
    {"friction_knee", "Pa", &FaceConstants::friction_knee, 1e300,
     "Normal stress above which the shear strength of a face increases at friction_angle_beyond instead of "
     "friction_angle, with bond.law = \"face\"."},
    {"friction_angle_beyond", "deg", &FaceConstants::friction_angle_beyond, 90.0,
     "Friction angle of an intact face at normal stresses above friction_knee; at most friction_angle."},
    {"residual_cohesion", "Pa", &FaceConstants::residual_cohesion, 1e300,
     "Cohesion of a face after it has failed in shear, with bond.law = \"face\"; 0 if not given."},
    {"softening_slip", "m", &FaceConstants::softening_slip, 1e300,
     "Slip over which the cohesion of a face falls to residual_cohesion; 0 if not given."},
    {"residual_tensile_strength", "Pa", &FaceConstants::residual_tensile_strength, 1e300,
     "Tensile strength of a face after it has failed in shear, with bond.law = \"face\"; 0 if not given."},
    {"softening_opening", "m", &FaceConstants::softening_opening, 1e300,
     "Opening over which residual_tensile_strength falls to 0; 0 if not given."},
};

}  // namespace crackle
