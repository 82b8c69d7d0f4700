// SPDX-License-Identifier: GPL-3.0-or-later
// A specimen in half boxes under the normal force of a direct shear test, in equilibrium, before it is sheared.
// Tested by tests/specimens/loading/direct_shear_test.cpp.
#pragma once

#include "specimens/loading/virtual_test.hpp"

namespace crackle {

/// Unbalanced force on any body over the normal force on a particle, at most, and of the upper box over the whole.
inline constexpr double most_unbalanced_pressed = 1e-5;

/// Moves the bodies by linear solutions until the forces on them are balanced; strains count from there.
/// @throws InputError where the specimen has no linear solution, or breaks under the normal force alone
void press(VirtualTest& test);

}  // namespace crackle
