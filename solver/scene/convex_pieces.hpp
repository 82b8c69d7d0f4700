// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a simple polygon into convex pieces, so that its signed distance can be computed piece by piece.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Convex pieces of a simple counter-clockwise polygon, as lists of corner indices. A convex polygon is a single piece.
/// Otherwise it is triangulated by ear clipping, and triangles are merged across unnecessary diagonals. The number of
/// pieces is at most four times the minimum (Hertel and Mehlhorn 1983).
std::vector<std::vector<std::uint32_t>> convex_pieces(std::span<const Vec2> corners);

}  // namespace crackle
