// SPDX-License-Identifier: GPL-3.0-or-later
// Brings the specimen of a direct shear test to equilibrium under the normal force, before it is sheared.
// Tested by tests/specimens/loading/direct_shear_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Largest unbalanced force on a body, relative to the normal force per particle; on the upper box, relative to the
/// whole normal force.
inline constexpr double most_unbalanced_pressed = 1e-5;

/// Moves the bodies by the displacements of successive linear solutions until the forces on them balance. Strains are
/// measured from the resulting state.
/// @throws InputError if the specimen has no linear solution, or if it breaks under the normal force alone
void press(VirtualTest& test);

}  // namespace crackle
