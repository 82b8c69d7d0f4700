// SPDX-License-Identifier: GPL-3.0-or-later
// A calibration on one page: targets and what fresh packings reach, keys with their intervals, what was tried, curves
// beside measured ones.
// Tested by tests/tools/calibrate/calibrate_test.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "specimens/calibration/calibrate.hpp"

namespace crackle::tools {

/// The page's bytes. @param folder of the calibration
std::string calibration_page(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder);

}  // namespace crackle::tools
