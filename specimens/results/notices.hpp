// SPDX-License-Identifier: GPL-3.0-or-later
// Notices of summary.json: what a reader must know to judge a test's results.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/results/numerical_errors.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// All notices of a test: the notices from its setup, and notices on its results.
/// @param viscous_share  the fraction of the largest stress that dashpots carry when loading begins
std::vector<std::string> notices_of(const parts::Loading& loading, const char* stress_unit, const TestSetup& setup,
                                    const TestState& state, const World& world, double viscous_share);

/// A notice if companion runs became unstable, the specimen has not failed, or the peaks disagree; empty if the peaks
/// agree.
std::string notice_of_companions(const FailureTracker& failure, const NumericalErrors& errors);

}  // namespace crackle
