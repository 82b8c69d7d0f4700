// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the pairs of bodies that are close enough for their contact points to be listed.
//
// Bodies are sorted into a uniform grid by centroid. Each pair is found from its larger body, which searches its
// bounding box enlarged by the bounding radius of the next smaller body. This works without user settings for any
// mixture of sizes, including platens and containers.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Centroid of a body, m.
inline Vec2 centre_of(const BodyState& body) { return {body.x, body.y}; }

/// Neighbour-list skin of a pair of bodies, m: the pair is listed as long as its gap is at most this value.
inline double skin_between(const World& world, BodyIndex i, BodyIndex j) {
    return world.list.half_skin_of(i) + world.list.half_skin_of(j);
}

/// Pairs of bodies whose bounding boxes and bounding circles are closer than thick + skin. A pair i < j is stored as i
/// << 32 | j; the list is sorted.
std::vector<std::uint64_t> near_pairs(const World& world);

}  // namespace crackle
