// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: what came out of a test in one place, with its numerical errors. Keys, units and signs stand in the
// file itself (`units`, `columns`), and in FILES.md. Until the specimen has failed, what refers to the peak is called
// ..._so_far.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "specimens/measures/crack_thresholds.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/recordings/test_summary.hpp"
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

/// The rows that peak, moduli and thresholds are read from: those of the first loading where the case unloads.
FirstLoading judged_rows(const TestCase& test, const TestState& state);
/// Of a compression between platens; of others nothing is known.
std::optional<CrackThresholds> crack_thresholds_of(const TestCase& test, const TestSetup& setup,
                                                   const TestState& state);

/// @param errors from the test's companions, if they were run
TestSummary make_summary(const TestCase& test, const TestSetup& setup, const TestState& state, const World& world,
                         const TestTiming& timing, const NumericalErrors* errors = nullptr);

}  // namespace crackle
