// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a campaign: curves of all packings as a band, figures as distributions, and figures over an axis.
// Tested by tests/tools/plot/campaign_panels_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// Curves of one point of a plan.
struct CurveBundle {
    std::string label;
    std::string stress_unit = "N/m";
    std::string kind = {};                                       ///< of test: what its stress and strain are called
    std::vector<std::vector<std::pair<double, double>>> curves;  ///< strain, stress; strain grows
};

/// At equal strains from 0 to the largest that at least half of the curves reach: the median of those that reach it,
/// and the smallest and largest (the range that `share` of them leaves out at each side).
struct Band {
    std::vector<double> strain, low, median, high;
};
Band band_of(const CurveBundle& bundle, double share = 0.1, std::size_t strains = 200);

/// One curve that no test of a plan gave: a laboratory's.
struct LabelledCurve {
    std::string label;
    std::vector<std::pair<double, double>> points;  ///< strain, stress in the units of the bundles
};

/// Of a file, named after it. @throws as read_measured_curve()
LabelledCurve labelled_curve(const std::filesystem::path& file);

/// Bands with their medians, measured curves dashed over them.
Panel curve_bands(const std::vector<CurveBundle>& bundles, const std::vector<LabelledCurve>& measured = {});

/// Values of one figure at some points of a plan.
struct Sample {
    std::string label;
    std::vector<double> values;
    double mean = 0.0, low = 0.0, high = 0.0;  ///< of the mean; not a number: no interval
};

/// Each sample as its values in a row, with the mean and its interval beside.
Panel distributions(const std::string& title, const std::string& unit, const std::vector<Sample>& samples);

/// Means with intervals over the values of an axis, one line a series, and the values as small points.
struct Series {
    std::string label;
    std::vector<double> x;        ///< in any order
    std::vector<Sample> samples;  ///< one an x
    bool joined = true;           ///< by a line
};
Panel over_axis(const std::string& x_title, const std::string& x_unit, const std::string& y_title,
                const std::string& y_unit, const std::vector<Series>& all);

}  // namespace crackle::plot
