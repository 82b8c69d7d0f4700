// SPDX-License-Identifier: GPL-3.0-or-later
// Kick and drift of bodies, compiled for what the scene has and for an instruction set: v += a·kick, x += v·Δt.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/instruction_set.hpp"
#include "solver/world/speeds.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Moves bodies `begin` to `end`. @param kick s
using MoveRange = Speeds (*)(World& world, double kick, std::int64_t begin, std::int64_t end);
/// Moves the bodies of a list and clears their forces, if they are not needed in the next pass.
using MoveListed = Speeds (*)(World& world, double kick, const BodyIndex* bodies, std::int64_t count);

/// @param turning some bodies have a frame that turns with them
template <InstructionSet>
MoveRange move_range_of(bool gravity, bool turning);
/// @param clear Bodies::force of these bodies are left as 0: not where the consistent integrator looks at them again
template <InstructionSet>
MoveListed move_listed_of(bool gravity, bool turning, bool clear);

/// Those that suit a world.
MoveRange move_range_for(const World& world);
MoveListed move_listed_for(const World& world, bool turning, bool clear);

}  // namespace crackle
