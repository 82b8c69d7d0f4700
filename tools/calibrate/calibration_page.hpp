// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a calibration: targets with the mean results of new packings, calibrated keys with their intervals, the
// points that were tried, and curves compared with measured ones.
// Tested by tests/tools/calibrate/calibrate_test.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "specimens/calibration/calibrate.hpp"

namespace crackle::tools {

/// The page as HTML. @param folder the calibration's folder
std::string calibration_page(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder);

}  // namespace crackle::tools
