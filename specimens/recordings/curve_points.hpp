// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the stress-strain curve of a results table to a list of points, and finds the stress at a given strain.
// Tested by tests/specimens/recordings/curve_points_test.cpp.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "specimens/recordings/test_results.hpp"

namespace crackle {

using CurvePoints = std::vector<std::pair<double, double>>;  ///< pairs of strain and stress

/// Points of the rows that have both values; empty if the table has no column axial_strain or axial_stress.
CurvePoints strain_and_stress(const NumberTable& table);

/// Stress where a curve first reaches a strain, linearly interpolated; NaN if the curve never reaches it.
double stress_at(std::span<const std::pair<double, double>> curve, double strain);

}  // namespace crackle
