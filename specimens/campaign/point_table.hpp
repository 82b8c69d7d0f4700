// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign's results by points of its plan: what the packings of each point say.
// Tested by tests/specimens/campaign/campaign_test.cpp.
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

struct PointSummary {
    std::string test;
    std::vector<std::pair<std::string, LedgerCell>> axes;  ///< those that are for it
    std::int64_t planned = 0, done = 0, gone_wrong = 0;
    std::int64_t unfailed = 0;      ///< done, and not failed by max_axial_strain: they have no strength
    std::vector<std::size_t> rows;  ///< of the results, as asked
    bool area_units = false;
    std::map<std::string, MeanFigure> figures;
    std::map<std::string, MeanBias> biases;  ///< where the plan has companions

    std::string at() const;  ///< "material.cohesion = 2e7, …"; empty without axes
};

/// Figures that refer to the peak: of a test that has not failed they refer to the largest stress so far, and belong to
/// no mean.
bool refers_to_peak(std::string_view figure);

/// Names of figures that are numbers, in the order of summary.json.
std::vector<std::string> numeric_figures(const LedgerTable& results);

/// Of these, what is looked at first: moduli and strength.
std::vector<std::string> usual_figures(const LedgerTable& results);

/// @param figures that are asked for @throws InputError for one that no test has, naming those there are
std::vector<PointSummary> summarise(const LedgerTable& results, const std::vector<std::string>& figures);

/// Of a figure, as in summary.json; empty for none, or one that it does not list.
/// @param column its name; of an element of a list "joints[2].length" and its like
std::string unit_of_figure(const std::string& column, bool area_units);

/// What the error of a mean is mostly made of, and what would lessen it, as a sentence.
std::string verdict_on(const MeanFigure& mean, const MeanBias& bias);

/// As CSV, a row a point and figure, in the order asked for.
std::string points_csv(const std::vector<PointSummary>& points, const std::vector<std::string>& figures);
/// As CSV, a row a test, as the view `results` of the ledger but for what differs from machine to machine.
std::string tests_csv(const LedgerTable& results);

}  // namespace crackle
