// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <cstddef>

namespace crackle {

/// How well a target's surface predicts points that were left out of the fit.
struct SurfaceQuality {
    std::size_t target = 0;
    bool quadratic = false;
    double left_out_error = 0.0;  ///< root mean square error of predicting a left-out point, in logarithms
};

}  // namespace crackle
