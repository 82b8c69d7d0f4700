// SPDX-License-Identifier: GPL-3.0-or-later
// A stress-strain curve from elsewhere: a laboratory's.
// Tested by tests/specimens/calibration/rock_test.cpp.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace crackle {

/// Strain and stress, of a table (solver/files/table_reader.hpp) with the columns axial_strain and axial_stress; rows
/// that lack one (empty, or nan) are left out. @throws InputError naming file, and line or column
std::vector<std::pair<double, double>> read_measured_curve(const std::filesystem::path& file);

}  // namespace crackle
