// SPDX-License-Identifier: GPL-3.0-or-later
// Computes forces, sums them and moves bodies in one sweep over the points, while the data are in the cache.
//
// Points of the smaller kinds (platens, walls) are processed first. Those of the largest kind, which has the most
// points, follow in the order of their lower body index. Once its last point is processed, the force on a body is
// complete and no later point uses the body, so it can move at once. The forces on a body are summed in this order.
// Each thread processes a range of blocks of the largest kind. If the first points of a body belong to another thread,
// that thread's forces are added first, so that sums do not depend on the number of threads.
#pragma once

#include <cstdint>

#include "solver/base/instruction_set.hpp"
#include "solver/contact/pass.hpp"
#include "solver/stepping/motion.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Updates Workers::plan if the neighbour list, the driven bodies or the number of threads have changed.
void plan_sweep(World& world);

/// Prepares Bodies::force for summing the forces of a force pass.
void clear_forces(World& world);

/// Computes the forces of all points, sums them, and moves all bodies except driven ones, on all threads of the world.
/// Call plan_sweep() and clear_forces() first. A body moves only after its last point. A thread that finds a
/// broken bond moves no further bodies, so that no body of a broken bond has moved; no body is moved if slips are
/// watched. Events are thus recorded with bodies at time n.
/// @param view a view of this world, with the features of its contacts @param move the function that moves bodies; null
/// to leave them in place
using Sweep = void (*)(World& world, const PassView& view, MoveListed move, double kick);
template <InstructionSet>
void sweep_of(World& world, const PassView& view, MoveListed move, double kick);

/// Returns sweep_of() for the chosen instruction set.
Sweep chosen_sweep();

/// Moves the bodies that the sweep has left in place. @return largest speed of all bodies except driven ones
Speeds move_the_rest(World& world, MoveListed move, double kick);

}  // namespace crackle
