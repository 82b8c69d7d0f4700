// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of contact points, a block of points of one kind at a time, by kernels compiled for what the scene has.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstddef>

#include "solver/contact/features.hpp"
#include "solver/world/world.hpp"

namespace crackle {

ContactFeatures features_of(const World& world);

/// Neighbouring points of one kind: one at least, at most block_points.
struct PointBlock {
    PointIndex begin, end;
    std::size_t number;  // into EnergyAccount::blocks
    PointForce* forces;  // of the points, to be filled
};

PointIndex blocks_of_kind(const World& world, std::size_t kind);
/// Number of a kind's first block.
std::size_t first_block_of(const World& world, std::size_t kind);
/// Of all kinds.
std::size_t block_count(const World& world);
PointBlock block_of(const World& world, std::size_t kind, PointIndex block, PointForce* forces);

/// Forces of a block at the present positions: shear springs, bond breaking and losses included.
using ForceKernel = void (*)(World& world, const PointBlock& block);
ForceKernel force_kernel(const ContactFeatures& features, std::size_t kind);

/// Only the geometry of all points at the present positions, as the force kernels take it: what the narrow phase costs.
/// Changes nothing but the edges that points remember. Must be called by all threads of a parallel region (or by one
/// thread alone); ends without a barrier.
void geometry_pass(World& world);

}  // namespace crackle
