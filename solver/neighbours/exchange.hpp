// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces the neighbour list with a new one. The state of each point (shear spring, bond, flags) is carried over by a
// linear merge of the two lists, which are sorted in the same way (world/point_order.hpp).
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include "solver/neighbours/point_lists.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Replaces the points of the world and carries over the state of points that were already listed. @param lists the new
/// points; empty on return
void exchange_points(World& world, PointLists& lists);

/// Determines the law, the effective mass and, if still missing, the stiffness and strength factors of each point. Call
/// this after bonds have been made or set to be unbreakable.
void find_point_properties(World& world);

}  // namespace crackle
