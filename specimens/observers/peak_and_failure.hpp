// SPDX-License-Identifier: GPL-3.0-or-later
// The peak of a test, which is the specimen's strength, its largest stress, and when it has failed.
//
// The peak is the first maximum that a drop follows: the stress stays below a share of the largest so far (the peak
// less strength_drop) for a tenth of the strain there, and for ten rows (of at least 2000 over the largest strain):
// where loading has hardly begun a tenth of the strain is nothing, and the first rows of a specimen that its platens
// only just touch go up and down. What comes after may be larger: columns of rubble carry again once they are wedged.
// Until a drop has followed, the peak is the largest stress so far. The test ends when the stress stays below another
// share of its largest (half, settable) in the same way; then the specimen has failed, whatever the drop asked for.
#pragma once

#include <cstdint>
#include <limits>

namespace crackle {

/// Stress below a share of a maximum, and since when.
struct StressDrop {
    double since = std::numeric_limits<double>::quiet_NaN();  ///< travel; not a number: not below
    std::int64_t row = -1;                                    ///< that began it

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("since", s.since);
        visit("row", s.row);
    }
};

/// Finds peak, largest stress and failure in the rows of a curve, one after the other. Stress and strain positive in
/// the sense of the test.
struct FailureTracker {
    double strength_drop = 0.1;  ///< share of the peak
    double share_of_peak = 0.5;  ///< of the largest stress: the test ends below
    double peak_stress = 0.0;    // N/m
    double peak_strain = 0.0;
    std::int64_t peak_row = -1;   ///< -1: no stress yet
    double largest_stress = 0.0;  // N/m, so far
    double strain_at_largest = 0.0;
    double travel_at_largest = 0.0;
    std::int64_t largest_row = -1;
    StressDrop drop, collapse;
    bool failed = false;     ///< the peak is known: a drop has followed it, or the test ends
    bool collapsed = false;  ///< the test ends

    /// Adds the next row. @param travel strain gone through back and forth, by which a drop lasts: the strain itself
    /// where the platen does not turn round @return whether it is a new peak
    bool update(std::int64_t row, double strain, double travel, double stress);
    bool update(std::int64_t row, double strain, double stress) { return update(row, strain, strain, stress); }

    bool larger_after_peak() const { return largest_row > peak_row; }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("strength_drop", s.strength_drop);
        visit("share_of_peak", s.share_of_peak);
        visit("peak_stress", s.peak_stress);
        visit("peak_strain", s.peak_strain);
        visit("peak_row", s.peak_row);
        visit("largest_stress", s.largest_stress);
        visit("strain_at_largest", s.strain_at_largest);
        visit("travel_at_largest", s.travel_at_largest);
        visit("largest_row", s.largest_row);
        visit("drop", s.drop);
        visit("collapse", s.collapse);
        visit("failed", s.failed);
        visit("collapsed", s.collapsed);
    }
};

/// Strain that the stress must stay below, as a share of the strain at the maximum.
inline constexpr double failure_strain_share = 0.1;
inline constexpr std::int64_t failure_rows = 10;

}  // namespace crackle
