// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a simple polygon into convex pieces, so that its signed distance can be taken piece by piece.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Convex pieces of a simple counter-clockwise polygon, as lists of corner numbers. One piece where it is convex
/// already; otherwise ears are cut and triangles merged again across diagonals that are not needed (Hertel and Mehlhorn
/// 1983: at most four times the least number of pieces).
std::vector<std::vector<std::uint32_t>> convex_pieces(std::span<const Vec2> corners);

}  // namespace crackle
