// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of test curves, prepared for diagrams against axial strain.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/case/kinds/test_kind.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

const Colour& colour_of(const PlottedTest& test);
const std::vector<double>& column(const TestResults& results, const char* name);
double largest_of(const std::vector<PlottedTest>& tests, const char* name);   ///< largest value of a column, at least 0
double smallest_of(const std::vector<PlottedTest>& tests, const char* name);  ///< smallest value of a column, at most 0

/// Points of a curve. A point less than 0.01 pt from the previous point is omitted, unless it is the last point.
std::vector<Point> curve_points(const Axes& axes, const std::vector<double>& x, double x_unit,
                                const std::vector<double>& y, double y_unit);

/// Names of stress and strain for these tests; specific to the kind of test if all are of one kind.
CurveNames names_of(const std::vector<PlottedTest>& tests);
/// Names of stress and strain for a kind of test.
CurveNames names_of_kind(const std::optional<LoadingKind>& kind);

std::vector<Legend::Entry> entries_of(const std::vector<PlottedTest>& tests);
/// Scale that includes 0, the strains of all tests, and `other`. @param width width of the panel, pt
Scale strain_scale(const std::vector<PlottedTest>& tests, double width, double other = 0.0);

}  // namespace crackle::plot
