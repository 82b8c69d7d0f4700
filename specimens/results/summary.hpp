// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: what came out of a test in one place, with its numerical errors. Keys, units and signs stand in the
// file itself
// (`units`, `columns`). Until the specimen has failed, what refers to the peak is called ..._so_far.
#pragma once

#include <nlohmann/json.hpp>

#include "specimens/case/case_file.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct NumericalErrors;

/// Wall-clock figures of the whole test, resumed parts included, s. The only keys that differ between two runs of one
/// case.
struct TestTiming {
    double wall_seconds = 0.0;  ///< whole process
    double step_seconds = 0.0;  ///< stepping loop with rebuilds, breaks and observers
    int threads = 1;
};

/// @param errors from the test's companions, if they were run
nlohmann::ordered_json make_summary(const TestCase& test, const TestSetup& setup, const TestState& state,
                                    const World& world, const TestTiming& timing,
                                    const NumericalErrors* errors = nullptr);

}  // namespace crackle
