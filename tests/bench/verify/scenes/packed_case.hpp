// SPDX-License-Identifier: GPL-3.0-or-later
// A case for a small packed rock, without a file: the shipped rock's material with fewer circles.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>

#include "specimens/parts/resolved_case.hpp"

namespace crackle::verification {

/// 120 circles in a box twice as high as wide, with uniformly distributed radii of 15 to 25 mm and a mean overlap of
/// 77.4 µm; k_n 1e7 N/m, k_s = k_n/4, φ 27 degrees, damping ratio 0.2.
/// @param rate 1/s
ResolvedCase packed_case(std::int64_t seed, LoadingKind kind, double rate, double max_strain);
/// Adds a mesh of Voronoi cells with gaps of 1 mm, bonded with a thickness of 1.08 mm.
void mesh_voronoi(ResolvedCase& test);

}  // namespace crackle::verification
