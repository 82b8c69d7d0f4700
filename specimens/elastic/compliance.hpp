// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a bonded rectangle of polygons or circles, from linear solutions under uniform tractions on its four
// sides:
//
//     (ε_x, ε_y, γ_xy) = S (σ_x, σ_y, τ_xy)            S in 1/Pa (area units) or m/N, stress tensile positive
//
// The matrix S follows from three load cases, with mean strains from the displacements u of the sides:
//     ε_ij = ½∮(u_i n_j + u_j n_i) ds / A
// There are no platens, which would restrain oblique joints. A persistent set of joints at spacing S, with normal n and
// stiffnesses K_n and K_s per length, adds (Amadei and Goodman 1981)
//
//     ε = (n⊗[u] + [u]⊗n)/(2S),   [u] = (n·σn) n/K_n + (σn - (n·σn) n)/K_s
//
// Tested by tests/specimens/elastic/compliance_test.cpp; verified by tests/verification/claims_test.cpp.
#pragma once

#include <array>

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Compliance matrix. Rows: ε_x, ε_y, γ_xy; columns: σ_x, σ_y, τ_xy.
using Compliance = std::array<std::array<double, 3>, 3>;

/// Compliance of `world`: bonded polygons whose outer edges lie inside `box`, or bonded circles, loaded where they
/// reach a side.
/// @param inset  distance of the polygons' outer edges from the sides of the box, m
/// @throws InputError if no body reaches a side, or if there is no linear solution
Compliance compliance_of(const World& world, const Domain& box, double inset);

/// Additional compliance due to a persistent set of joints.
/// @param angle  angle of the traces, counter-clockwise from +x, rad  @param spacing  distance between the traces, m
Compliance compliance_of_set(double angle, double spacing, double normal_stiffness, double shear_stiffness);

}  // namespace crackle
