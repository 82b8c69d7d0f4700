// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/peak_and_failure.hpp"

#include <cmath>

namespace crackle {

bool FailureTracker::update(std::int64_t row, double strain, double stress) {
    if (stress > peak_stress) {
        peak_stress = stress;
        peak_strain = strain;
        peak_row = row;
        below_since = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    if (peak_row < 0 || stress >= share_of_peak * peak_stress) {
        below_since = std::numeric_limits<double>::quiet_NaN();
        return false;
    }
    if (std::isnan(below_since)) {
        below_since = strain;
        below_row = row;
    }
    failed = failed || (strain - below_since >= failure_strain_share * peak_strain && row - below_row >= failure_rows);
    return false;
}

}  // namespace crackle
