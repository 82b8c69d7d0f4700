// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points of a world as blocks for the kernels (solver/contact/kernels.hpp), and what these need to know.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstddef>

#include "solver/contact/features.hpp"
#include "solver/contact/kernels.hpp"
#include "solver/world/world.hpp"

namespace crackle {

ContactFeatures features_of(const World& world);

PointIndex blocks_of_kind(const World& world, std::size_t kind);
/// Number of a kind's first block.
std::size_t first_block_of(const World& world, std::size_t kind);
/// Of all kinds.
std::size_t block_count(const World& world);
PointBlock block_of(const World& world, std::size_t kind, PointIndex block, PointForce* forces);

/// Only the geometry of all points at the present positions, as the force kernels take it: what the narrow phase costs.
/// Changes nothing but the edges that points remember. Must be called by all threads of a parallel region (or by one
/// thread alone); ends without a barrier.
void geometry_pass(World& world);

}  // namespace crackle
