// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the output of a calibration: the case files with the calibrated values, calibration.json, and a table.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "specimens/calibration/calibrate.hpp"

namespace crackle {

/// The contents of calibration.json: targets, keys with intervals, frontier, undetermined directions, cost.
nlohmann::ordered_json calibration_json(const Rock& rock, const CalibrationOutcome& outcome);

/// Formats the outcome as text, for a terminal or a file.
std::string calibration_text(const Rock& rock, const CalibrationOutcome& outcome);

/// Remarks on targets that are out of reach, keys that are not determined, and packings left out of all means; empty if
/// there are none.
std::string calibration_remarks(const Rock& rock, const CalibrationOutcome& outcome);

/// TOML lines with the calibrated keys and their intervals, to be included in a case.
std::string found_keys_toml(const Rock& rock, const CalibrationOutcome& outcome);

/// Writes DIR/cases/TEST.toml for each test (with default values written out), rock.toml (found_keys_toml()),
/// calibration.json and calibration.txt.
/// @throws OutputError
void write_calibration(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder);

}  // namespace crackle
