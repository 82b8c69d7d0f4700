// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are hard on the engine, and the results of running them. The claims «Stability under stress» run them
// briefly, and `crackle-bench stress` for any number of steps.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/world/world.hpp"
#include "tests/bench/verify/claim.hpp"

namespace crackle::verification {

struct StressScene {
    std::string name;
    World (*build)();
};

/// Scenes of loose bodies in a closed box, at nine tenths of the time step that the engine would choose.
const std::vector<StressScene>& stress_scenes();

/// Outcome of a run.
struct Endured {
    std::int64_t steps = 0;      ///< number of steps completed
    double closing_error = 0.0;  ///< largest closing error, relative to the largest total of kinetic, stored and lost
                                 ///< energy
    std::string error;           ///< message of an UnstableRun; empty if the run was completed
};

/// Runs steps, and checks the energy account and the world's health every `interval` steps.
Endured endure(World& world, std::int64_t steps, int interval = 50);

/// Largest accepted closing error, relative to the energy, at the step that the engine derives for loose bodies.
/// loose_step_share is chosen so that errors stay below this value.
inline constexpr double open_account = 0.02;

}  // namespace crackle::verification
