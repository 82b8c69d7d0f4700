// SPDX-License-Identifier: GPL-3.0-or-later
// Strengths of one rock from the folders that tests and campaigns have left: compressions with the pressure on their
// sides, and tensions. That it is one rock is checked by the cases: tests may differ in what keys_of_rock() leaves out
// (specimens/campaign/identity.hpp), and in a gap between cells that was derived from their number.
// Tested by tests/tools/commands/envelope_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "specimens/envelope/strength_envelope.hpp"

namespace crackle {

/// What is taken for the strength of a compression; tensile strengths are peaks.
struct StrengthMeasure {
    std::string figure = "peak_stress";  ///< a stress of summary.json: largest_stress of tests that harden
    std::optional<double> strain = {};   ///< in its place the stress that the curve has at this axial strain

    std::string spoken() const;      ///< "strengths", "largest stresses", "stresses at a strain of 0.02"
    std::string spoken_one() const;  ///< "strength", "largest stress", "stress at a strain of 0.02"
};

struct MeasuredStrengths {
    StrengthMeasure measure;
    std::vector<StrengthPoint> compressions;  ///< confinement 0 or that of a biaxial test
    std::vector<double> tensions;             ///< tensile strengths, positive, of tests that parted in their gauge
    std::vector<std::string> left_out;        ///< what has no strength, and why, a sentence each
    std::string unit;                         ///< "Pa" or "N/m"
};

/// @param folders of `crackle test` and of `crackle campaign`, any number of both
/// @throws InputError for a folder without results, tests in several units or of several rocks, one test twice; for a
/// figure that is no stress
MeasuredStrengths read_strengths(std::span<const std::filesystem::path> folders, const StrengthMeasure& measure = {});

}  // namespace crackle
