// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one test of a campaign. The results are those of `crackle test` on the same case.
// Tested by tests/specimens/campaign/campaign_test.cpp and outcomes_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "specimens/campaign/packing_store.hpp"
#include "specimens/campaign/plan.hpp"

namespace crackle {

struct Summary;

/// How a test of a campaign ended.
inline constexpr const char* row_done = "done";        ///< the test has results, whether or not the specimen failed
inline constexpr const char* row_refused = "refused";  ///< the case turned out to be invalid
inline constexpr const char* row_unstable = "unstable";
inline constexpr const char* row_timed_out = "timed out";
/// An error of the operating system or of a library, such as lack of memory.
inline constexpr const char* row_failed = "failed";
inline constexpr const char* row_crashed = "crashed";  ///< the worker process was killed, or ended without an answer

/// Message for a test that failed because memory ran out.
inline constexpr const char* no_memory = "found less memory than the test needs; use fewer --workers";

/// Kinds of rows: a test with results, a case that cannot be tested, or a failure of the machine or the program.
enum class RowKind : std::uint8_t {
    result,   ///< the test has results
    verdict,  ///< the case cannot be tested; another run would end in the same way
    /// The machine or the program failed, so there is no verdict on the case; the same command runs the test again.
    failure
};
/// Kind of a row. @param state  the state recorded in the ledger: one of the texts above
RowKind kind_of_row(std::string_view state);

/// Results of a test by name: numbers and strings. Boolean values are 0 or 1.
using Figures = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

/// Text for the number of tests without results: "3 gone wrong", or "3 gone wrong, 1 of them because of a system error;
/// run the same command again to repeat it".
std::string spoken_wrong(std::int64_t gone_wrong, std::int64_t failures);

/// Outcome of one test, as recorded in the ledger.
struct RowResult {
    std::string identity;
    std::string state;
    int exit = 0;         ///< exit code of `crackle test` on the same case
    std::string message;  ///< description of the error
    std::vector<std::string> notices;
    double processor_seconds = 0.0, wall_seconds = 0.0;
    Figures figures;  ///< empty unless state is "done"
    /// SHA-256 of the kept curve and summary.json; empty if not kept.
    std::string curve_sha256 = {}, summary_sha256 = {};
};

/// Where and how the tests of a campaign are run.
struct RowPlace {
    std::filesystem::path folder;  ///< folder of the campaign
    bool endless = false;          ///< see TestOptions::endless
};

/// Numbers, strings and flags of a summary by name; those in tables as "packing.void_ratio". Unknown values are left
/// out. So are values that describe the run rather than the test: run times, versions, file names.
Figures figures_of(const Summary& summary);

/// Identity of a row's test, and base name of its kept files.
struct RowNames {
    std::string identity, kept;
};

/// Runs the test of one row. @param keep  which files to keep: curves/NAME.csv, tests/NAME/
/// @throws OutputError if the campaign's folder cannot be written
RowResult run_row(const ResolvedCase& test, const RowNames& names, Keep keep, const RowPlace& place,
                  PackingStore& packings, const std::function<bool()>& interrupted = {});

}  // namespace crackle
