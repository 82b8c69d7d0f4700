// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies are near enough to each other for contact points between them to be listed.
//
// Bodies lie in a uniform grid by their centroids. A pair is found by its larger body, which searches its own bounding
// box widened by the reach of the next smaller body: any mixture of sizes, platens and containers included, needs no
// user hint.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

inline Vec2 centre_of(const BodyState& body) { return {body.x, body.y}; }

/// How far the surfaces of a listed pair may be apart beyond what they touch at, m.
inline double skin_between(const World& world, BodyIndex i, BodyIndex j) {
    return world.list.half_skin_of(i) + world.list.half_skin_of(j);
}

/// Pairs of bodies whose bounding boxes and circles come within thick + skin, as i << 32 | j with i < j, sorted.
std::vector<std::uint64_t> near_pairs(const World& world);

}  // namespace crackle
