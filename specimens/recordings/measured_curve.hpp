// SPDX-License-Identifier: GPL-3.0-or-later
// A measured stress-strain curve, for example from a laboratory.
// Tested by tests/specimens/calibration/rock_test.cpp.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace crackle {

/// Reads strain and stress from a table (solver/files/table_reader.hpp) with the columns axial_strain and axial_stress.
/// Rows in which either value is missing (empty or nan) are skipped.
/// @throws InputError that names the file, and line or column
std::vector<std::pair<double, double>> read_measured_curve(const std::filesystem::path& file);

}  // namespace crackle
