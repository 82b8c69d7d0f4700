// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a bonded rectangle of polygons or circles by the linear solution under uniform tractions on its four
// sides:
//
//     (ε_x, ε_y, γ_xy) = S (σ_x, σ_y, τ_xy)            S in 1/Pa (area units) or m/N, stress tensile positive
//
// three load cases, strains of the whole by the motion of its sides, ε_ij = ½∮(u_i n_j + u_j n_i) ds / A. No platens:
// they would hinder oblique joints. Persistent sets of joints at the spacing S, of normal n, stiffnesses K_n and K_s a
// length, add (Amadei and Goodman 1981)
//
//     ε = (n⊗[u] + [u]⊗n)/(2S),   [u] = (n·σn) n/K_n + (σn - (n·σn) n)/K_s
//
// Tested by tests/specimens/elastic/compliance_test.cpp; verified by tests/verification/claims_test.cpp.
#pragma once

#include <array>

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// By rows: ε_x, ε_y, γ_xy; columns: σ_x, σ_y, τ_xy.
using Compliance = std::array<std::array<double, 3>, 3>;

/// @param world bonded polygons that fill `box` but for `inset`, m, by which their outer edges lie inside it, or
/// circles, of which those that reach a side are pulled there @throws InputError where a side has none, or there is no
/// linear solution
Compliance compliance_of(const World& world, const Domain& box, double inset);

/// What a persistent set adds. @param angle rad, of its traces from +x  @param spacing m
/// @param normal_stiffness, shear_stiffness Pa/m
Compliance compliance_of_set(double angle, double spacing, double normal_stiffness, double shear_stiffness);

}  // namespace crackle
