// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a direct shear test other than its peak.
// Tested by tests/specimens/measures/verdicts_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Results of a direct shear test other than its peak; NaN if unknown.
struct ShearBoxFigures {
    double residual =
        std::numeric_limits<double>::quiet_NaN();  ///< shear stress, N/m, mean over the last tenth of the strain
    double dilation_at_peak = std::numeric_limits<double>::quiet_NaN();  ///< dilation angle, degrees: arctangent of the
                                                                         ///< slope of rise over shear displacement
};

/// @param reached_its_strain  whether the test reached its largest strain
/// @param height, length  m; lateral strain is rise/height, and axial strain is shear displacement/length
ShearBoxFigures measure_shear_box(std::span<const CurveRow> rows, std::int64_t peak_row, bool reached_its_strain,
                                  double height, double length);

}  // namespace crackle
