// SPDX-License-Identifier: GPL-3.0-or-later
// Random generation of circles, mode 0 of in_gm.dat. Circles with uniformly distributed radii are placed at random in
// the domain until the requested void ratio is reached. The circles overlap at first; during the run, dashpots and
// friction bring them to rest.
//
//     N = round(A / ((1 + e) π <r²>)),  <r²> = (r1² + r1 r2 + r2²)/3     582 for 80 x 80, r 1-2, e 0.5 (DEMseg guide)
//
// Here A is the area of the domain and e the void ratio. std::mt19937_64 has a standardised sequence, and the
// distributions are implemented here, so a seed gives identical results everywhere. Source: DEMseg guide I.7; the
// formula for N is inferred from the 582 circles of the guide's example (FORMATS.md).
// Tested by tests/tools/commands/run_test.cpp.
#pragma once

#include <cstdint>

#include "solver/demseg/geometry.hpp"

namespace crackle {

/// Number of circles that gives the requested void ratio. @throws InputError if the number is 0 or exceeds the largest
/// body id
std::int64_t random_circle_count(const RandomGeometry& geometry);

/// Circles 1 to N at rest, entirely inside the domain, as a validated mode-1 scene.
/// @throws InputError if a circle does not fit into the domain
DeckGeometry make_random_circles(const RandomGeometry& geometry, std::uint64_t seed);

}  // namespace crackle
