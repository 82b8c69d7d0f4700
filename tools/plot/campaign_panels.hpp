// SPDX-License-Identifier: GPL-3.0-or-later
// Diagrams of a campaign: curves of all packings as bands, distributions of results, and results plotted against an
// axis of the plan.
// Tested by tests/tools/plot/campaign_panels_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/axes.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// Unit in which a result is shown: small dimensionless values, such as strains, are in thousandths. @param name the SI
/// unit; empty if the result has no unit
Unit figure_unit(double largest, const std::string& name);

/// Curves of all packings for one point of a plan.
struct CurveBundle {
    std::string label;
    std::string stress_unit = "N/m";
    std::string kind = {};  ///< kind of test, which determines how stress and strain are named
    /// Pairs of strain and stress, in order of increasing strain.
    std::vector<std::vector<std::pair<double, double>>> curves;
};

/// Band of curves: median, minimum and maximum after dropping the fraction `share` of the curves on either side. Values
/// are taken at equally spaced strains up to the largest strain that at least half of the curves reach. At each strain,
/// only the curves that reach it are used.
struct Band {
    std::vector<double> strain, low, median, high;
};
Band band_of(const CurveBundle& bundle, double share = 0.1, std::size_t strains = 200);

/// Bands with medians; measured curves are drawn as dashed lines.
Panel curve_bands(const std::vector<CurveBundle>& bundles, const std::vector<LabelledCurve>& measured = {});

/// Values of one result at one point of a plan.
struct Sample {
    std::string label;
    std::vector<double> values;
    /// Mean and its confidence interval; low and high are NaN if there is no interval.
    double mean = 0.0, low = 0.0, high = 0.0;
};

/// Diagram with one row per sample: its individual values, its mean and the interval of the mean.
Panel distributions(const std::string& title, const std::string& unit, const std::vector<Sample>& samples);

/// Samples at values of an axis, drawn as means with intervals, and as small dots for the individual values.
struct Series {
    std::string label;
    std::vector<double> x;        ///< in any order
    std::vector<Sample> samples;  ///< one sample for each x
    bool joined = true;           ///< whether a line connects the means
};
Panel over_axis(const std::string& x_title, const std::string& x_unit, const std::string& y_title,
                const std::string& y_unit, const std::vector<Series>& all);

}  // namespace crackle::plot
