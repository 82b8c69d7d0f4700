// SPDX-License-Identifier: GPL-3.0-or-later
// One test of a campaign, run by itself: the figures are those of `crackle test` on the same case.
// Tested by tests/specimens/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "specimens/campaign/packing_store.hpp"
#include "specimens/campaign/plan.hpp"

namespace crackle {

class TestSummary;

/// How a test of a campaign ended.
inline constexpr const char* row_done = "done";        ///< whether it failed or not
inline constexpr const char* row_refused = "refused";  ///< the case turned out to be impossible
inline constexpr const char* row_unstable = "unstable";
inline constexpr const char* row_failed = "failed";    ///< the system or a library failed
inline constexpr const char* row_crashed = "crashed";  ///< its process ended by itself
inline constexpr const char* row_timed_out = "timed out";

/// What came of a test, by name: numbers and words; flags are 0 and 1.
using Figures = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

struct RowResult {
    std::string identity;
    std::string state;
    int exit = 0;         ///< code that `crackle test` would have ended with
    std::string message;  ///< of what went wrong
    std::vector<std::string> notices;
    double processor_seconds = 0.0, wall_seconds = 0.0;
    Figures figures;  ///< none unless done
};

struct RowPlace {
    std::filesystem::path folder;  ///< of the campaign
    bool endless = false;          ///< as TestOptions::endless
};

/// What a summary states of a test and not of the run: numbers, words and flags by their names, those within tables
/// as "packing.void_ratio". Left out: clocks, versions, names of files, and what is not known.
Figures figures_of(const TestSummary& summary);

/// By what a row's test is known, and what is kept of it called.
struct RowNames {
    std::string identity, kept;
};

/// @param test of the row  @param keep what is left beside the result: curves/NAME.csv, tests/NAME/
/// @throws OutputError where the campaign's folder cannot be written
RowResult run_row(const TestCase& test, const RowNames& names, Keep keep, const RowPlace& place, PackingStore& packings,
                  const std::function<bool()>& interrupted = {});

}  // namespace crackle
