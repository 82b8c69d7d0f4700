// SPDX-License-Identifier: GPL-3.0-or-later
// A new list takes the place of the old one. What a point remembers (shear spring, bond, flags) is carried over by one
// linear merge of the two, which have the same order (world/point_order.hpp).
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include "solver/neighbours/point_lists.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Replaces the points of the world, carrying over what the old ones remember. @param lists left empty
void exchange_points(World& world, PointLists& lists);

/// Of each point its law, its shares where it has none yet, and its effective mass: to be called where bonds were made
/// or held.
void find_point_properties(World& world);

}  // namespace crackle
