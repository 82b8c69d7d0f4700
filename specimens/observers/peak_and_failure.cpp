// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/peak_and_failure.hpp"

#include <cmath>

namespace crackle {
namespace {

/// Whether the stress, including this row, has stayed below `share` of the largest stress for long enough.
bool lasts(StressDrop& below, const FailureTracker& f, double share, std::int64_t row, double travel, double stress) {
    if (stress >= share * f.largest_stress) {
        below = {};
        return false;
    }
    if (std::isnan(below.since)) below = {travel, row};
    return travel - below.since >= failure_strain_share * f.travel_at_largest && row - below.row >= failure_rows;
}

}  // namespace

bool FailureTracker::update(std::int64_t row, double strain, double travel, double stress) {
    if (stress > largest_stress) {
        largest_stress = stress;
        strain_at_largest = strain;
        travel_at_largest = travel;
        largest_row = row;
        drop = collapse = {};
        if (failed) return false;
        peak_stress = stress;
        peak_strain = strain;
        peak_row = row;
        return true;
    }
    if (largest_row < 0) return false;
    collapsed = lasts(collapse, *this, share_of_peak, row, travel, stress) || collapsed;
    failed = lasts(drop, *this, 1.0 - strength_drop, row, travel, stress) || failed || collapsed;
    return false;
}

}  // namespace crackle
