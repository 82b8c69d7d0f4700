// SPDX-License-Identifier: GPL-3.0-or-later
// First pass of a step: every contact point computes its force into its own slot.
#pragma once

#include "solver/world.hpp"

namespace crackle {

/// What the scene has; absent features cost nothing because a kernel compiled without them is picked.
struct ContactFeatures {
    bool friction;  // any law with μ > 0
    bool damping;   // any law with a dashpot
    bool bonds;
    bool ledger;
    bool consistent;  // first and last steps of contacts by contact_opening.hpp
};

ContactFeatures features_of(const World& world);

/// Forces of all points at the present positions: shear springs, bond breaking and losses included.
/// Must be called by all threads of a parallel region (or by one thread alone); ends without a barrier.
void contact_pass(World& world, const ContactFeatures& features);

/// Only the geometry of all points at the present positions, as contact_pass() takes it and called like it: what the
/// narrow phase costs. Changes nothing but the edges that points remember.
void geometry_pass(World& world);

/// Blocks of points of one kind, for sizing World::loss_blocks.
PointIndex block_count(const World& world);

}  // namespace crackle
