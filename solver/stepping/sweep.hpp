// SPDX-License-Identifier: GPL-3.0-or-later
// Forces, their sums and the motion of bodies in one sweep over the points, while all of it is in the cache.
//
// Points of the smaller kinds (platens, walls) are done first, then those of the largest, which lie in the order of
// their lower body: a body whose last point is done has its whole force, no point still to come looks at it, and it can
// move at once. That is also the order in which a body's forces are added up. Each thread has a run of blocks of the
// largest kind; what it finds for a body whose first points belong to another thread is added after that one's, so that
// the bytes of a sum do not depend on the threads.
#pragma once

#include <cstdint>

#include "solver/base/instruction_set.hpp"
#include "solver/contact/pass.hpp"
#include "solver/stepping/motion.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Workers::plan again if the list, the driven bodies or the threads have changed since.
void plan_sweep(World& world);

/// Makes Bodies::force ready to be added to.
void clear_forces(World& world);

/// Forces of all points, their sums, and the motion of all bodies but the driven ones, on the threads of the world;
/// after plan_sweep() and clear_forces(). Where a thread meets a broken bond it moves no body from there on, and none
/// at all where slips are watched: events are to be recorded as all was at time n.
/// @param move null: bodies stay
void sweep(World& world, const ContactFeatures& features, MoveListed move, double kick);

/// The same, as compiled for an instruction set.
template <InstructionSet>
void sweep_of(World& world, const ContactFeatures& features, MoveListed move, double kick);

/// Moves those that have been kept in place. @return of all bodies but the driven ones
Speeds move_the_rest(World& world, MoveListed move, double kick);

}  // namespace crackle
