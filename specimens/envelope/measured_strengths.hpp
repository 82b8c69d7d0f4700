// SPDX-License-Identifier: GPL-3.0-or-later
// Strengths of one rock, read from the folders of tests and campaigns: those of compression tests with their confining
// pressures, and those of tension tests. All cases must describe the same rock. They may differ in keys that
// keys_of_rock() leaves out (specimens/campaign/identity.hpp), and in a gap between cells that was derived from the
// number of cells.
// Tested by tests/tools/commands/envelope_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "specimens/envelope/strength_envelope.hpp"

namespace crackle {

/// The stress that counts as the strength of a compression test; tensile strengths are always peaks.
struct StrengthMeasure {
    /// Name of a stress in summary.json, for example largest_stress for specimens that harden.
    std::string figure = "peak_stress";
    std::optional<double> strain = {};  ///< if set, the strength is the stress at this axial strain

    /// Name in the plural: "strengths", "largest stresses", "stresses at a strain of 0.02".
    std::string spoken() const;
    /// Name in the singular: "strength", "largest stress", "stress at a strain of 0.02".
    std::string spoken_one() const;
};

/// Strengths read from folders of results.
struct MeasuredStrengths {
    StrengthMeasure measure;
    std::vector<StrengthPoint> compressions;  ///< strengths of compression tests (confinement 0) and biaxial tests
    /// Tensile strengths, positive. Specimens that separated outside the gauge length are left out.
    std::vector<double> tensions;
    std::vector<std::string> left_out;  ///< one sentence for each test without a strength, giving the reason
    /// Number of tests in `left_out` that a campaign recorded as system failures (RowKind::failure).
    std::int64_t failures = 0;
    std::string unit;  ///< unit of the stresses, "Pa" or "N/m"
    /// Number of compressions whose largest stress is that of the end of loading: lower bounds of a strength.
    std::int64_t bounds = 0;
};

/// Reads the strengths of one rock. @param folders  results of `crackle test` and of `crackle campaign`, in any number
/// @throws InputError for a folder without results, tests in different units or of different rocks, a repeated test, or
/// a figure that is not a stress
MeasuredStrengths read_strengths(std::span<const std::filesystem::path> folders, const StrengthMeasure& measure = {});

}  // namespace crackle
