// SPDX-License-Identifier: GPL-3.0-or-later
// Changing what a pair of materials does at its contacts while a world runs.
// Tested by tests/solver/stepping/change_law_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// One number of a material pair that may change, as Material and MaterialPair have it.
struct LawKey {
    const char* name;
    const char* unit;  ///< of StiffnessUnits::point
};
/// normal_stiffness, shear_stiffness (N/m, or Pa), friction_angle (degrees; of a coulomb bond's envelope),
/// residual_friction_angle (of contacts without a bond, BondLaw::coulomb), tensile_strength, cohesion (N, or Pa).
const std::vector<LawKey>& law_keys();

/// Sets it for contacts between materials a and b, indices into Settings::materials, from the coming force pass on:
/// the stable step is found again, and the account of energy begins again, since springs store another energy at once.
/// A back-tension bond keeps its overlap δ0, so its strength k_n δ0 follows the stiffness. A damping ratio stays as it
/// is. Contacts with the domain's walls change where a = b, those across joints in all that these do not have their
/// own: what is left of a stiffness in series with a joint's stays the same share of it.
/// @throws InputError for an unknown name, a value out of range, strengths with μT > C, a strength under back-tension;
/// UnstableRun where a given time step is too large for a stiffness
void change_law(World& world, std::size_t a, std::size_t b, const std::string& name, double value);

}  // namespace crackle
