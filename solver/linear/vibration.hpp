// SPDX-License-Identifier: GPL-3.0-or-later
// Lowest undamped vibration modes of a bonded world, K u = ω² M u, with driven degrees of freedom held.
// Tested by tests/verification/claims_test.cpp and tests/solver/linear/stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/springs.hpp"

namespace crackle {

/// An undamped vibration mode.
struct VibrationMode {
    double frequency;               // rad/s
    std::vector<BodyMotion> shape;  ///< motion of each body, scaled so that the largest mass-scaled component is 1
};

/// Largest number of modes that can be requested, including free motions.
inline constexpr std::int64_t most_modes = 500;

/// The `count` lowest modes that store energy, in order of increasing frequency; found by Lanczos on the inverse
/// (Spectra, Eigen).
/// @param free_motions number of free motions of this world (find_free_motions()), which precede these modes and are
/// omitted
/// @throws InputError if more than most_modes (including free motions) or more modes than exist are requested, or if
/// Lanczos does not converge
std::vector<VibrationMode> lowest_modes(const World& world, std::int64_t count, std::int64_t free_motions);

}  // namespace crackle
