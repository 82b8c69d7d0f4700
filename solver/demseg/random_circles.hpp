// SPDX-License-Identifier: GPL-3.0-or-later
// Random generation of circles, mode 0 of in_gm.dat: so many circles of uniformly distributed radii that they have the
// void ratio asked for, dropped into the domain wherever they fall. They overlap at first; dashpots and friction calm
// them.
//
//     N = round(A / ((1 + e) π <r²>)),  <r²> = (r1² + r1 r2 + r2²)/3     582 for the guide's 80 x 80, r 1-2, e 0.5
//
// A area of the domain, e void ratio. Own distributions on std::mt19937_64, whose sequence the standard fixes, so that
// a seed gives the same bytes everywhere. Source: DEMseg guide I.7; the count is inferred from its 582 (FORMATS.md).
// Tested by tests/tools/commands/run_test.cpp.
#pragma once

#include <cstdint>

#include "solver/demseg/geometry.hpp"

namespace crackle {

/// N of the header. @throws InputError if it is 0 or does not fit a body number.
std::int64_t random_circle_count(const RandomGeometry& geometry);

/// Circles 1..N at rest, wholly inside the domain, as a validated mode-1 scene.
/// @throws InputError if a circle does not fit into the domain.
DeckGeometry make_random_circles(const RandomGeometry& geometry, std::uint64_t seed);

}  // namespace crackle
