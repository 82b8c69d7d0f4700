// SPDX-License-Identifier: GPL-3.0-or-later
// Lists the possible contact points of a pair of close bodies, or of a body and a wall.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Contact points by kind; within a kind, sorted by pair of bodies.
using PointLists = std::array<Array<ContactPoint>, point_kinds>;

/// Lists the possible contact points of all near pairs, and of bodies with walls. @param pairs pairs of bodies from
/// near_pairs()
PointLists list_points(const World& world, const std::vector<std::uint64_t>& pairs);

}  // namespace crackle
