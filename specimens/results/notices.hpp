// SPDX-License-Identifier: GPL-3.0-or-later
// What a reader of a test's numbers must know beside them: the notices of summary.json.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/results/numerical_errors.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Those of the start, and what the curve turned out to resolve badly.
/// @param viscous_share of the largest stress, that the dashpots bear when loading begins
std::vector<std::string> notices_of(const TestCase& test, const TestSetup& setup, const TestState& state,
                                    const World& world, double viscous_share);

/// What the companions show of the peak, in words; empty where they agree, or have not run.
std::string notice_of_companions(const FailureTracker& failure, const NumericalErrors& errors);

}  // namespace crackle
