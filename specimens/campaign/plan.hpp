// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign's plan: which tests it is made of, as its file states them and as they come out of it.
//
//   title = "…"
//   [[test]]     name, case, set      kinds of test, each a case file with keys set over it
//   [[axis]]     key, values | from, to, count, spacing; tests
//   [design]     points, sequence     of the axes that have from and to and no count
//   [packings]   count, first_seed    each a seed of everything that is random in a case; without it a case has its own
//   [run]        keep, time_limit
//
// A point is one of these tests at one combination of the axes; its rows are the same point with the packings. The
// packings are the same ones for all points.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "specimens/campaign/axis.hpp"
#include "specimens/case/case_file.hpp"

namespace crackle {

enum class Keep : std::uint8_t {
    figures,  ///< what the ledger holds
    curves,   ///< and a curve.csv a test
    all,      ///< and all files of `crackle test`
};

/// How a row's test differs from what the plan asks for: companions show what step and rate do to a mean.
enum class Variant : std::uint8_t { as_asked, half_step, half_rate };
inline constexpr int variants = 3;
const char* name_of(Variant variant);  ///< "as_asked", …

struct PlannedTest {
    std::string name;
    std::filesystem::path file;
    std::vector<CaseSetting> settings;  ///< over the case, before the axes'
    CaseFiles files;
};

/// One kind of test at one combination of the axes.
struct PlanPoint {
    std::size_t test = 0;               ///< into Plan::tests
    std::vector<CaseSetting> settings;  ///< of the axes that are for it, in their order
    std::vector<std::size_t> axes;      ///< into Plan::axes, of these
    std::vector<std::string> seeds;     ///< keys of its case that a packing's number goes to
    std::int64_t own_seed = 1;          ///< of its case's packing
};

struct PlanRow {
    std::size_t point = 0;  ///< into Plan::points
    std::int64_t seed = 0;  ///< of the packing
    Variant variant = Variant::as_asked;
};

struct Plan {
    std::filesystem::path file;
    std::string text;  ///< of the file
    std::string title;
    std::vector<PlannedTest> tests;
    std::vector<Axis> axes;
    bool own_seeds = true;  ///< without [packings]: each case has the seeds that it states
    std::int64_t packings = 1, first_seed = 1;
    Keep keep = Keep::figures;
    double time_limit = 0.0;  ///< s of the wall clock a test; 0: none

    std::vector<PlanPoint> points;
    std::vector<PlanRow> rows;  ///< by packing, point, variant: rows of one packing lie together

    /// The test of a row. @throws InputError as read_case()
    TestCase test_of(const PlanRow& row) const;
    const PlannedTest& kind_of(const PlanRow& row) const { return tests[points[row.point].test]; }
};

inline constexpr std::int64_t most_plan_rows = 10'000'000;

/// How many points the design axes have, and how they are laid.
struct DesignRequest {
    Sequence sequence = Sequence::sobol;
    std::size_t points = 0;
};

/// Fills in points and rows, and judges every point's keys and values.
/// @param with_companions rows of half the step and half the rate, too
/// @throws InputError, also where there would be more than most_rows
void expand(Plan& plan, const DesignRequest& design, bool with_companions, std::int64_t most_rows = most_plan_rows);

/// Of points that somebody has put in: their seeds, and whether they are possible. @throws InputError
void judge_points(Plan& plan);

/// As it stands in a plan: 30, 1.5e7, "voronoi".
std::string value_text(const CaseValue& value);

}  // namespace crackle
