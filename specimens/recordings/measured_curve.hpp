// SPDX-License-Identifier: GPL-3.0-or-later
// Measured stress-strain curves and strengths, for example from a laboratory.
// Tested by tests/specimens/recordings/measured_curve_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle {

using StrainsAndStresses = std::vector<std::pair<double, double>>;

/// Reads strain and stress from a table (solver/files/table_reader.hpp). Its heading names the columns and may give
/// their units, as in `axial_strain (%), axial_stress (MPa)`. Without a unit, a strain is a fraction, a stress is in Pa
/// (or N/m), and all other values are in SI units. The columns displacement and length may replace axial_strain, and
/// force and area may replace axial_stress: strain = displacement/length, stress = force/area.
/// Rows that lack a value (empty or nan) are skipped.
/// @throws InputError that names the file, and line or column
StrainsAndStresses read_measured_curve(const std::filesystem::path& file);

/// A curve from another source, for example measured in a laboratory.
struct LabelledCurve {
    std::string label;
    StrainsAndStresses points;  ///< stresses in the unit of the tests with which it is compared
};

/// Reads a curve from a file; its label names the file. @throws InputError under the conditions of
/// read_measured_curve()
LabelledCurve labelled_curve(const std::filesystem::path& file);

/// Reads a curve to draw over the curves of tests. @throws InputError also if the tests are of several kinds, or if the
/// scales differ
LabelledCurve measured_beside(const std::vector<Recording>& tests, const std::filesystem::path& file);

/// Compressive strength measured on cores.
struct StrengthOfCores {
    double confinement = 0.0, strength = 0.0;  // Pa
    double error = 0.0;                        // Pa; 0 if the table states no error
};

/// Reads a table with the columns confining_pressure and strength, and error if there is one, with units as in
/// `strength (MPa)`; without a unit, values are in Pa. @throws InputError that names the file, and line or column
std::vector<StrengthOfCores> read_measured_strengths(const std::filesystem::path& file);

/// Requires that measured and computed values fit on the same axis, since a factor above 50 between them means that a
/// unit is missing. @param found, computed largest values @param unit for the message, with a leading space
/// @param example a heading with a unit, for the message @throws InputError that names the file and the column
void require_like_scale(const std::string& file, const char* column, double found, double computed,
                        const std::string& unit, const char* example);
/// Requires similar scales on both axes of a curve. @param strain, stress largest values of the computed curves, stress
/// in `unit`
void require_like_scale(const std::string& file, const StrainsAndStresses& measured, double strain, double stress,
                        const std::string& unit);

}  // namespace crackle
