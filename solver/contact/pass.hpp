// SPDX-License-Identifier: GPL-3.0-or-later
// Divides the contact points of a world into blocks, runs kernels on them (solver/contact/kernels.hpp), and determines
// which features the kernels need.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstddef>

#include "solver/contact/features.hpp"
#include "solver/contact/kernels.hpp"
#include "solver/world/world.hpp"

namespace crackle {

ContactFeatures features_of(const World& world);

PointIndex blocks_of_kind(const World& world, std::size_t kind);
/// Index of the first block of a kind of point.
std::size_t first_block_of(const World& world, std::size_t kind);
/// Number of blocks of all kinds.
std::size_t block_count(const World& world);
PointBlock block_of(const World& world, std::size_t kind, PointIndex block, PointForce* forces);

/// Computes only the geometry of all points at the current positions, as the force kernels do, to measure the cost of
/// the narrow phase. It changes only the stored edges that points faced last. Call it from all threads of a parallel
/// region or from a single thread; there is no barrier at its end.
void geometry_pass(World& world);

}  // namespace crackle
