// SPDX-License-Identifier: GPL-3.0-or-later
// Second pass of a step: every body adds up the forces of its points, always in the same order.
#pragma once

#include "solver/world.hpp"

namespace crackle {

/// World::forces from World::point_forces. Must be called by all threads of a parallel region (or by one thread alone);
/// ends without a barrier.
void gather_forces(World& world);

}  // namespace crackle
