// SPDX-License-Identifier: GPL-3.0-or-later
// What a calibration leaves in its folder, and says: the cases with the keys that were found, calibration.json, a
// table. Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "specimens/calibration/calibrate.hpp"

namespace crackle {

/// Targets, keys with intervals, frontier, undetermined directions, cost.
nlohmann::ordered_json calibration_json(const Rock& rock, const CalibrationOutcome& outcome);

/// The same as a text, for a terminal or a file.
std::string calibration_text(const Rock& rock, const CalibrationOutcome& outcome);

/// Of these, what is out of reach, what is not determined, and packings that are in no mean; empty where all is well.
std::string calibration_remarks(const Rock& rock, const CalibrationOutcome& outcome);

/// TOML lines of the found keys with their intervals: what a case has to say to be this rock.
std::string found_keys_toml(const Rock& rock, const CalibrationOutcome& outcome);

/// Writes DIR/cases/TEST.toml for each test (everything in the open), rock.toml (found_keys_toml()), calibration.json
/// and calibration.txt. @throws OutputError
void write_calibration(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder);

}  // namespace crackle
