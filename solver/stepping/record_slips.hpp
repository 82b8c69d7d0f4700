// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/record_slips_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Appends an event to Bonds::slips for each back-tension bond that has reached its Coulomb limit for the first time,
/// in point order. Call it after a force pass and before bodies move, in worlds with Bonds::watch_slips. The computing
/// time is proportional to the number of listed points.
void record_slips(World& world);

}  // namespace crackle
