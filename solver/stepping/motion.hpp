// SPDX-License-Identifier: GPL-3.0-or-later
// Kick and drift of bodies, compiled for the features of a scene and for an instruction set: v += a·kick, x += v·Δt.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/instruction_set.hpp"
#include "solver/world/workers.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Moves the bodies from index `begin` up to, but not including, `end`. @param kick the length of the kick, s
using MoveRange = Speeds (*)(World& world, double kick, std::int64_t begin, std::int64_t end);
/// Moves the listed bodies and, if compiled to do so, clears their forces. @param kick the length of the kick, s
using MoveListed = Speeds (*)(World& world, double kick, const BodyIndex* bodies, std::int64_t count);

/// Returns the function for moving bodies. @param turning whether some bodies have a frame that rotates with them
template <InstructionSet>
MoveRange move_range_of(bool gravity, bool turning);
/// Returns the function for moving listed bodies. @param clear whether to set their Bodies::force to 0; must be false
/// for the consistent integrator, which reads the forces again
template <InstructionSet>
MoveListed move_listed_of(bool gravity, bool turning, bool clear);

/// The functions compiled for the features of a world.
MoveRange move_range_for(const World& world);
MoveListed move_listed_for(const World& world, bool turning, bool clear);

}  // namespace crackle
