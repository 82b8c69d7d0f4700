// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign's plan: the tests in its file, and the resulting points and rows.
//
//   title = "…"
//   [[test]]     name, case, set      tests, each a case file with keys that override it
//   [[axis]]     key, values | from, to, count, spacing; tests
//   [design]     points, sequence     for the axes that have from and to but no count
//   [packings]   count, first_seed    seeds for all random numbers; without this table, each case keeps its own seeds
//   [run]        keep, time_limit
//
// A point is one of the plan's tests at one combination of axis values. The rows of a point run its test on each of the
// packings, which are the same for all points.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "specimens/campaign/axis.hpp"
#include "specimens/case/case_file.hpp"

namespace crackle {

/// Files to be kept of a test.
enum class Keep : std::uint8_t {
    figures,  ///< no files; only the ledger has the results
    curves,   ///< curve.csv of each test
    all,      ///< all files that `crackle test` writes
};
constexpr auto list_names(Keep) { return in_order("figures", "curves", "all"); }

/// How a row's test differs from the planned one. Companion runs at half the step or half the rate show the effect of
/// time step and rate on a mean.
enum class Variant : std::uint8_t { as_asked, half_step, half_rate };
constexpr auto list_names(Variant) { return in_order("as_asked", "half_step", "half_rate"); }
inline constexpr int variants = static_cast<int>(table_of_names<Variant>.size());

/// A test of a plan: a case file with settings.
struct PlannedTest {
    std::string name;
    std::filesystem::path file;
    std::vector<CaseSetting> settings;  ///< keys that override the case and are overridden by the axes
    CaseFiles files;
};

/// A test of the plan at one combination of axis values.
struct PlanPoint {
    std::size_t test = 0;               ///< index into Plan::tests
    std::vector<CaseSetting> settings;  ///< values of the axes that apply to the test, in the order of these axes
    std::vector<std::size_t> axes;      ///< indices in Plan::axes of the axes that apply to the test
    std::vector<std::string> seeds;     ///< keys of the case that are set to the packing's seed
    std::int64_t own_seed = 1;          ///< seed of the packing as written in the case
};

/// One test to be run.
struct PlanRow {
    std::size_t point = 0;  ///< index into Plan::points
    std::int64_t seed = 0;  ///< seed of the packing
    Variant variant = Variant::as_asked;
};

/// A plan with all its tests, points and rows.
struct Plan {
    std::filesystem::path file;
    std::string text;  ///< contents of the plan file
    std::string title;
    std::vector<PlannedTest> tests;
    std::vector<Axis> axes;
    bool own_seeds = true;  ///< whether each case keeps its own seeds, as in a plan without [packings]
    std::int64_t packings = 1, first_seed = 1;
    Keep keep = Keep::figures;
    double time_limit = 0.0;  ///< largest wall-clock time per test, s; 0: no limit

    std::vector<PlanPoint> points;
    /// Ordered by packing, then point, then variant, so that rows with the same packing are adjacent.
    std::vector<PlanRow> rows;

    /// The test of a row. @throws InputError under the same conditions as read_case()
    ResolvedCase test_of(const PlanRow& row) const;
    /// The planned test to which a row belongs.
    const PlannedTest& kind_of(const PlanRow& row) const { return tests[points[row.point].test]; }
};

inline constexpr std::int64_t most_plan_rows = 10'000'000;

/// Number of points in the design, and the sequence used.
struct DesignRequest {
    Sequence sequence = Sequence::sobol;
    std::size_t points = 0;
};

/// Adds all points and rows to a plan, and checks the keys and values of every point.
/// @param with_companions  whether to add rows with half the time step and half the rate
/// @throws InputError, also if there would be more than `most_rows` rows
void expand(Plan& plan, const DesignRequest& design, bool with_companions, std::int64_t most_rows = most_plan_rows);

/// Determines the seed keys of the points in a plan, and checks whether their cases are valid. @throws InputError
void judge_points(Plan& plan);

/// Text of a value as written in a plan: 30, 1.5e7, "voronoi".
std::string value_text(const CaseValue& value);

}  // namespace crackle
