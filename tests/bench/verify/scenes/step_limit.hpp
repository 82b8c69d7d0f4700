// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a world just below and just above its exact stable step.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>

#include "solver/world/world.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {

/// The bonded specimen at its stress-free positions, without velocities and drives.
World at_rest(World world);

/// Adds rows that check that the engine's bounds are below the exact step. At 0.99 of the exact step, random velocities
/// must stay bounded; at 1.01 the mode found must grow at the predicted rate. No bond may break.
void check_step_limit(Rows& rows, const std::string& name, const World& rest);

}  // namespace crackle::verification
