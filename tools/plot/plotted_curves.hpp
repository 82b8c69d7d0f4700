// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of curves, and how diagrams over axial strain draw them.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

const Colour& colour_of(const PlottedTest& test);
const std::vector<double>& column(const TestResults& results, const char* name);
/// Of the summary; not a number where it has none.
double number_of(const PlottedTest& test, const char* key);
double largest_of(const std::vector<PlottedTest>& tests, const char* name);   ///< of a column, 0 at least
double smallest_of(const std::vector<PlottedTest>& tests, const char* name);  ///< likewise, 0 at most

/// A curve's points; those that lie within a hundredth of a point of the line before are left out.
std::vector<Point> curve_points(const Axes& axes, const std::vector<double>& x, double x_unit,
                                const std::vector<double>& y, double y_unit);

/// What stress and strain of these tests are called: by their kind, where they are of one.
struct CurveNames {
    const char* stress = "stress";
    const char* strain = "strain";
};
CurveNames names_of(const std::vector<PlottedTest>& tests);
/// Of one kind of test.
CurveNames names_of_kind(const std::string& kind);

std::vector<Legend::Entry> entries_of(const std::vector<PlottedTest>& tests);
Scale strain_scale(const std::vector<PlottedTest>& tests, double width);

}  // namespace crackle::plot
