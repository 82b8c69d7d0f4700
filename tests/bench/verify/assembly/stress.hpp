// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are hard on the engine, and what it makes of them; the claims «Stability under stress» run them briefly,
// `crackle-bench stress` for as long as wanted.
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

/// Loose bodies in a closed box, each at nine tenths of the step that would be derived.
const std::vector<StressScene>& stress_scenes();

/// What became of a run.
struct Endured {
    std::int64_t steps = 0;      ///< done
    double closing_error = 0.0;  ///< largest, over the energy that was ever there: kinetic, stored and lost
    std::string error;           ///< an UnstableRun's words; empty: it went through
};

/// Steps with the account of energy and the world's health looked at every `interval` steps.
Endured endure(World& world, std::int64_t steps, int interval = 50);

/// Share of the energy by which an account may stay open at the derived step of loose bodies: what loose_step_share
/// asks for.
inline constexpr double open_account = 0.02;

}  // namespace crackle::verification
