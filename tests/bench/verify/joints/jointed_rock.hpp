// SPDX-License-Identifier: GPL-3.0-or-later
// A rock of cells or circles with joint traces, in area units with coulomb bonds.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle::verification {

inline constexpr double rock_width = 0.6, rock_height = 1.2;    // m
inline constexpr double rock_modulus = 50e9, rock_ratio = 2.5;  // Pa, contact modulus; k_n over k_s
/// Largest gap at which two circles are bonded, relative to their mean radius; nearly all neighbours are bonded.
inline constexpr double bonded_range = 0.3;
inline constexpr double circles_diameter = 0.04;  // m, mean

/// About 500 circles with radii of 15 to 25 mm, meshed or not.
ResolvedCase jointed_rock(SpecimenKind kind, std::int64_t seed);

/// Adds a persistent joint set with a fixed spacing. @param angle degrees from +x @param through a point on one trace,
/// m
void add_set(ResolvedCase& test, double angle, double spacing, Vec2 through, const Joint& mechanics);

}  // namespace crackle::verification
