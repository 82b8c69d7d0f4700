// SPDX-License-Identifier: GPL-3.0-or-later
// Determines the peak of a test (the specimen's strength), the largest stress, and when the specimen has failed.
//
// The peak is the first maximum that is followed by a lasting drop. In a drop the stress is below the fraction 1 -
// strength_drop of its largest value up to then. A drop is lasting if it extends over a tenth of the strain at that
// maximum, and over at least ten rows (of at least 2000 up to the largest strain). Rows are counted as well because,
// shortly after loading begins, a tenth of the strain is tiny and stresses may fluctuate if the platens only just touch
// the specimen.
//
// Later stresses may be larger: rubble carries load again once it is wedged. Until a lasting drop has followed, the
// peak is the largest stress up to the current row; afterwards the peak is final (`failed`). The test ends
// (`collapsed`) when the stress stays below another fraction of its largest value (half by default) in the same way.
// Whether the test ends does not depend on strength_drop.
#pragma once

#include <cstdint>
#include <limits>

#include "solver/base/fields.hpp"

namespace crackle {

/// A period in which the stress is below a fraction of a maximum.
struct StressDrop {
    double since =
        std::numeric_limits<double>::quiet_NaN();  ///< strain travelled at its start; NaN if there is no drop
    std::int64_t row = -1;                         ///< row of the curve in which the drop started; -1 if there is none

    CRACKLE_FIELDS(since, row);
};

/// Finds the peak, the largest stress and failure while rows of a curve are added one by one. Stress and strain are
/// positive in the direction of loading.
struct FailureTracker {
    double strength_drop = 0.1;  ///< fraction by which stress must drop after a maximum to make it the peak
    double share_of_peak = 0.5;  ///< fraction of the largest stress below which the test ends
    double peak_stress = 0.0;    // N/m
    double peak_strain = 0.0;
    std::int64_t peak_row = -1;   ///< row of the peak; -1 if no stress has been positive yet
    double largest_stress = 0.0;  // largest stress up to the last row added, N/m
    double strain_at_largest = 0.0;
    double travel_at_largest = 0.0;
    std::int64_t largest_row = -1;
    StressDrop drop, collapse;
    bool failed = false;     ///< whether the peak is final: a drop has followed it, or the test ends
    bool collapsed = false;  ///< whether the test ends

    /// Adds the next row. @param travel  strain travelled back and forth, used to measure the length of a drop; equal
    /// to the strain if the platen never reverses @return whether the row is a new peak
    bool update(std::int64_t row, double strain, double travel, double stress);
    /// Adds the next row of a test whose platen never reverses.
    bool update(std::int64_t row, double strain, double stress) { return update(row, strain, strain, stress); }

    /// Whether the largest stress of the test came after its peak.
    bool larger_after_peak() const { return largest_row > peak_row; }

    CRACKLE_FIELDS(strength_drop, share_of_peak, peak_stress, peak_strain, peak_row, largest_stress, strain_at_largest,
                   travel_at_largest, largest_row, drop, collapse, failed, collapsed);
};

/// Range of strain over which the stress must stay below the limit, relative to the strain at the maximum.
inline constexpr double failure_strain_share = 0.1;
inline constexpr std::int64_t failure_rows = 10;

}  // namespace crackle
