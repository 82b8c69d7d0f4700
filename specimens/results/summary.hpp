// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: what came out of a test in one place, with its numerical errors. Keys, units and signs stand in the
// file itself (`units`, `columns`), and in FILES.md. Until the specimen has failed, what refers to the peak is called
// ..._so_far.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "specimens/measures/crack_thresholds.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/observers/quantity.hpp"
#include "specimens/results/json_number.hpp"
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

/// What a stress or modulus is called, and its unit, where out_of_plane_thickness has made it one of three dimensions.
inline constexpr const char* converted_suffix = "_pa";
inline constexpr const char* converted_unit = "Pa, the same over out_of_plane_thickness";

struct SummaryKey {
    Quantity what;
    bool in_units = true;    ///< stated in the file's own `units`
    bool converted = false;  ///< a stress or modulus: ..._pa stands beside it
};
/// In the order of the file. Keys of a table within stand behind it as `table.key`, `*` for any name and `[]` for each
/// entry of a list. A key whose meaning depends on the test stands once for each.
const std::vector<SummaryKey>& summary_keys();

/// The rows that peak, moduli and thresholds are read from: those of the first loading where the case unloads.
FirstLoading judged_rows(const TestCase& test, const TestState& state);
/// Of a compression between platens; of others nothing is known.
std::optional<CrackThresholds> crack_thresholds_of(const TestCase& test, const TestSetup& setup,
                                                   const TestState& state);

/// @param errors from the test's companions, if they were run
nlohmann::ordered_json make_summary(const TestCase& test, const TestSetup& setup, const TestState& state,
                                    const World& world, const TestTiming& timing,
                                    const NumericalErrors* errors = nullptr);

}  // namespace crackle
