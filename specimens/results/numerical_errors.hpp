// SPDX-License-Identifier: GPL-3.0-or-later
// The numerical errors that a test states with its peak (found as loading/companions.hpp explains).
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace crackle {

struct Companion {
    std::string name;  ///< "half_time_step", "half_rate", "half_damping", "double_damping"
    double peak_stress = 0.0, peak_strain = 0.0;
    double crack_initiation_stress = 0.0, crack_damage_stress = 0.0;  // N/m; NaN but of a compression
    std::string ended_by;  ///< as the test's own; "instability": it has no numbers worth comparing
    std::int64_t steps = 0;
    double time_step = 0.0, axial_strain_rate = 0.0;  ///< s, 1/s; means of its run
    double damping = 0.0;                             ///< of its contacts, over the test's; NaN where that has none
    double post_peak_difference = 0.0;                ///< mean |stress - the test's| from the peak on, over the peak
};

/// Relative errors of one number.
struct NumberError {
    double time_step = 0.0, rate = 0.0, damping = 0.0;  ///< largest change by the companions; NaN: that one is unstable
    double resolution = 0.0;                            ///< by the spacing of the rows it was found from
    double stated = 0.0;                                ///< NaN where a companion by step or rate is unstable
};

struct NumericalErrors {
    std::vector<Companion> companions;
    NumberError peak_stress, peak_strain;
    std::optional<NumberError> crack_initiation_stress, crack_damage_stress;  ///< of a compression
    std::optional<bool> peak_converged;  ///< no companion by step or rate is on another branch; none: no failure yet
};

}  // namespace crackle
