// SPDX-License-Identifier: GPL-3.0-or-later
// The profile of a run as a table: of the stepping loop each phase once, and what lies between them as the rest.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "solver/world/world.hpp"

namespace crackle {

/// Rows of {phase, seconds, share, calls, ns_per_particle_step}, and figures of the contact points. `narrow_phase` is
/// the part of `force` that the geometry costs, sampled.
/// @param particles bodies whose steps are counted @param step_seconds wall clock of the stepping loop, s
nlohmann::ordered_json profile_report(const Profile& profile, std::int64_t particles, std::int64_t steps,
                                      double step_seconds);

/// The same for people.
std::string profile_table(const nlohmann::ordered_json& report);

}  // namespace crackle
