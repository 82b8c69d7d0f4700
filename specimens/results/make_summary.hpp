// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the summary of a test: all its results and their numerical errors. If the specimen has not failed, keys of
// results that refer to the peak end in _so_far. Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "specimens/measures/crack_thresholds.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"
#include "specimens/summary/summary.hpp"

namespace crackle {

struct NumericalErrors;

/// Wall-clock times of the whole test, including resumed parts, and the number of threads. Only summary keys made from
/// these values differ between two runs of a case.
struct TestTiming {
    double wall_seconds = 0.0;  ///< wall-clock time of the whole test, s
    /// Wall-clock time of the stepping loop, s, with neighbour list rebuilds, bond breakage and observers.
    double step_seconds = 0.0;
    int threads = 1;
};

/// The rows from which peak, moduli and thresholds are computed: all rows, or, if the case unloads, the rows outside
/// its unloading cycles.
FirstLoading rows_without_cycles(const parts::Loading& loading, const TestState& state);
/// Crack thresholds of a compression test between platens; empty for other tests.
std::optional<CrackThresholds> crack_thresholds_of(const parts::Loading& loading, const PlacedApparatus& apparatus,
                                                   const TestState& state);

/// Makes the summary, which contains values from all parts of the case.
/// @param errors  the numerical errors from companion runs; null if there are none
Summary make_summary(const ResolvedCase& test, const TestSetup& setup, const TestState& state, const World& world,
                     const TestTiming& timing, const NumericalErrors* errors = nullptr);

}  // namespace crackle
