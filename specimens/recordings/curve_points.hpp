// SPDX-License-Identifier: GPL-3.0-or-later
// The stress-strain curve of a table of results as points, and what it has at a strain.
// Tested by tests/specimens/recordings/curve_points_test.cpp.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "specimens/recordings/test_results.hpp"

namespace crackle {

using CurvePoints = std::vector<std::pair<double, double>>;  ///< strain, stress

/// Rows that have both; none where the table lacks axial_strain or axial_stress.
CurvePoints strain_and_stress(const NumberTable& table);

/// Where a curve first comes to a strain, between its points; not a number where it never does.
double stress_at(std::span<const std::pair<double, double>> curve, double strain);

}  // namespace crackle
