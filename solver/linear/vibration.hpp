// SPDX-License-Identifier: GPL-3.0-or-later
// Lowest undamped vibration modes of a bonded world, K u = ω² M u, driven degrees of freedom held.
// Tested by tests/verification/claims_test.cpp and tests/solver/linear/stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/springs.hpp"

namespace crackle {

struct VibrationMode {
    double frequency;               // rad/s
    std::vector<BodyMotion> shape;  ///< per body, largest mass-scaled component 1
};

/// Most modes (free motions included) that are looked for at once.
inline constexpr std::int64_t most_modes = 500;

/// The `count` lowest modes that store energy, rising frequencies; found by Lanczos on the inverse (Spectra, Eigen).
/// @param free_motions of the same world, see find_free_motions(); they come first and are left out
/// @throws InputError for more than most_modes with the free motions, or more than there are, or no convergence
std::vector<VibrationMode> lowest_modes(const World& world, std::int64_t count, std::int64_t free_motions);

}  // namespace crackle
