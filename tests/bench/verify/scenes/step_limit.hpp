// SPDX-License-Identifier: GPL-3.0-or-later
// Runs just below and just above a world's exact stable step.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>

#include "solver/world/world.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {

/// A bonded specimen at its stress-free positions, where nothing moves and nothing is driven.
World at_rest(World world);

/// Rows: the engine's bounds lie below the exact step. At 0.99 of it random velocities stay bounded; at 1.01 the mode
/// that it names grows at the predicted rate. No bond breaks meanwhile.
void check_step_limit(Rows& rows, const std::string& name, const World& rest);

}  // namespace crackle::verification
