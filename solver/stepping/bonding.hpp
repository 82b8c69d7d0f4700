// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/allocation_test.cpp.
#pragma once

#include <cstdint>

#include "solver/world/world.hpp"

namespace crackle {

/// Back-tension bonding: every point of overlap δ > 0 between bodies gets δ0 = δ and loses its shear spring. Walls stay
/// unbonded. Sets the segment thickness first. @return points bonded.
std::int64_t bond_all(World& world, double thick);
/// After bonds have been entered in the points (flags, bond_overlap), by bond_all() or a reader of back-tensions:
/// counts them, clears what was remembered of the time before, and starts the account of energy again.
void finish_bonding(World& world);
/// Changes the segment thickness and invalidates the list.
void set_thickness(World& world, double thick);

}  // namespace crackle
