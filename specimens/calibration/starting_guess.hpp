// SPDX-License-Identifier: GPL-3.0-or-later
// Start values of a search if the rock file gives none: strengths and friction angle of the bonds, estimated from the
// targets. The formulas are for Voronoi grains in area units, and fit the values in specimens/rocks/README.md.
//
//                     coulomb bonds                    faces
//   tensile strength  T / (0.61 e^(-1.5 v))            T / (0.745 e^(-1.85 v))
//   cohesion          UCS (1 - sin φ)/(2·0.7 cos φ)    UCS (1 - sin φ)/(2·0.65 cos φ)
//   friction angle    1.1 m, at most 45                20 + 1.3 m, at most 50, degrees
//
// T is the rock's tensile strength, v the coefficient of variation of the bonds' strengths, and m that of Hoek and
// Brown. The rock has 0.7 or 0.65 of the Mohr-Coulomb strength of its bonds.
//
// m is a target itself, or follows from UCS and a strength σ1 under the pressure p: ((σ1 - p)² - UCS²)/(UCS p). For the
// shipped rocks, the start values are within a factor of 1.5 of the calibrated ones, so the first round of a search is
// near its solution.
// Tested by tests/specimens/calibration/starting_guess_test.cpp.
#pragma once

#include <vector>

namespace crackle {

struct Rock;

/// Values of the free keys at which the search starts. A key without a start value in the rock file starts at a guess
/// within its bounds if the targets allow one, otherwise in the middle of its bounds.
std::vector<double> starting_values(const Rock& rock);

}  // namespace crackle
