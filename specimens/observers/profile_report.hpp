// SPDX-License-Identifier: GPL-3.0-or-later
// The profile of a run as a table: time spent in each phase of the stepping loop, and outside these phases.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <string>

#include "solver/world/world.hpp"
#include "specimens/summary/run_figures.hpp"

namespace crackle {

/// Time of each phase, and numbers of contact points.
/// `narrow_phase` is the part of `force` spent on geometry, estimated by sampling.
/// @param particles  number of particles, for times per particle and step
/// @param step_seconds  wall-clock time of the stepping loop, s
ProfileFigures profile_report(const Profile& profile, std::int64_t particles, std::int64_t steps, double step_seconds);

/// Formats the report as a table for users.
std::string profile_table(const ProfileFigures& report);

}  // namespace crackle
