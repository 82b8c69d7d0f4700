// SPDX-License-Identifier: GPL-3.0-or-later
// The peak of a test, its largest stress so far, and when it has failed: the stress stays below a share of its peak
// (half, settable) for a tenth of the strain at peak, and for ten rows (of at least 2000 over the largest strain):
// where loading has hardly begun a tenth of the strain is nothing, and the first rows of a specimen that its platens
// only just touch go up and down.
#pragma once

#include <cstdint>
#include <limits>

namespace crackle {

/// Finds peak and failure in the rows of a curve, one after the other. Stress and strain positive in the sense of the
/// test.
struct FailureTracker {
    double share_of_peak = 0.5;
    double peak_stress = 0.0;  // N/m, largest so far
    double peak_strain = 0.0;
    std::int64_t peak_row = -1;                                     ///< -1: no stress yet
    double below_since = std::numeric_limits<double>::quiet_NaN();  ///< strain; not a number: not below
    std::int64_t below_row = -1;                                    ///< the row that began it
    bool failed = false;

    /// Adds the next row. @return whether it is a new peak
    bool update(std::int64_t row, double strain, double stress);

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("share_of_peak", s.share_of_peak);
        visit("peak_stress", s.peak_stress);
        visit("peak_strain", s.peak_strain);
        visit("peak_row", s.peak_row);
        visit("below_since", s.below_since);
        visit("below_row", s.below_row);
        visit("failed", s.failed);
    }
};

/// Strain that the stress must stay below, as a share of the strain at peak.
inline constexpr double failure_strain_share = 0.1;
inline constexpr std::int64_t failure_rows = 10;

}  // namespace crackle
