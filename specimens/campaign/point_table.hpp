// SPDX-License-Identifier: GPL-3.0-or-later
// Summarises a campaign's results: for each point of the plan, means over the packings.
// Tested by tests/specimens/campaign/campaign_test.cpp and point_table_test.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "specimens/campaign/ledger.hpp"
#include "specimens/statistics/mean.hpp"

namespace crackle {

/// Means over the packings of one point of a plan.
struct PointSummary {
    std::string test;
    std::vector<std::pair<std::string, LedgerCell>> axes;  ///< axes that apply to the test
    std::int64_t planned = 0, done = 0, gone_wrong = 0;
    std::int64_t failures = 0;  ///< number of tests in gone_wrong with a system failure (RowKind::failure)
    /// Number of finished tests whose specimen did not fail before max_axial_strain and therefore has no strength.
    std::int64_t unfailed = 0;
    std::int64_t invalid = 0;       ///< number of finished tests that are not valid for their kind
    std::vector<std::size_t> rows;  ///< indices into the rows of LedgerTable, in the order of the plan
    bool area_units = false;
    std::map<std::string, MeanFigure> figures;
    std::map<std::string, std::vector<double>>
        values;  ///< values from which each mean is computed, in the order of the packings' seeds
    std::map<std::string, MeanBias> biases;  ///< empty unless the plan has companion runs

    std::string at() const;  ///< "material.cohesion = 2e7, …"; empty if no axis applies
};

/// Whether a result refers to the peak. If the specimen has not failed, such results refer to the largest stress
/// reached and are left out of the means.
bool refers_to_peak(std::string_view figure);

/// Names of the numeric results, in the order of the keys in summary.json.
std::vector<std::string> numeric_figures(const LedgerTable& results);

/// Names of the results that most users need: moduli and strength.
std::vector<std::string> usual_figures(const LedgerTable& results);

/// Means and scatter of the requested results for each point.
/// @param figures  names of the results
/// @throws InputError if a requested result occurs in no test; the message lists the available results
std::vector<PointSummary> summarise(const LedgerTable& results, const std::vector<std::string>& figures);

/// Unit of a result as in summary.json; empty if the result has no unit or is not listed there.
/// @param column  name of the result, which may be an element of a list, such as "joints[2].length"
std::string unit_of_figure(const std::string& column, bool area_units);

/// A sentence on the main source of a mean's error and how to reduce it.
std::string verdict_on(const MeanFigure& mean, const MeanBias& bias);

/// The points as CSV, one row per point and result, in the requested order. Text that is not a number and begins with
/// = + - @ or a tab gets a leading apostrophe, since a spreadsheet would evaluate it.
std::string points_csv(const std::vector<PointSummary>& points, const std::vector<std::string>& figures);
/// The tests as CSV, one row per test: the view `results` of the ledger without machine-dependent columns.
std::string tests_csv(const LedgerTable& results);

}  // namespace crackle
