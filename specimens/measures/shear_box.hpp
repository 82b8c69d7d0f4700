// SPDX-License-Identifier: GPL-3.0-or-later
// What the curve of a direct shear test says beside its peak.
// Tested by tests/specimens/measures/verdicts_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

struct ShearBoxFigures {
    double residual = std::numeric_limits<double>::quiet_NaN();  ///< N/m, mean over the last tenth of the strain
    double dilation_at_peak =
        std::numeric_limits<double>::quiet_NaN();  ///< degrees, atan of the rise's slope over the way
};

/// @param reached_its_strain whether the test went on to its largest strain @param height, length m, that the rise (the
/// lateral strain) and the way (the axial strain) were taken over
ShearBoxFigures measure_shear_box(std::span<const CurveRow> rows, std::int64_t peak_row, bool reached_its_strain,
                                  double height, double length);

}  // namespace crackle
