// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points that a pair of near bodies, or a body and a wall, can have.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// By kind, in the order of the pairs.
using PointLists = std::array<Array<ContactPoint>, point_kinds>;

/// @param pairs as near_pairs() finds them
PointLists list_points(const World& world, const std::vector<std::uint64_t>& pairs);

}  // namespace crackle
