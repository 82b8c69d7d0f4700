// SPDX-License-Identifier: GPL-3.0-or-later
// Judges whether fresh packings reach a target.
//
// The last correction adjusted the keys until the packings used for it reached the target. The mean over fresh packings
// differs from theirs by chance. The verdict therefore depends on the standard error of the difference between the two
// means (difference_half_width()).
// Tested by tests/specimens/calibration/judgement_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/names.hpp"
#include "specimens/statistics/mean.hpp"

namespace crackle {

/// Final verdict on a target.
enum class TargetVerdict : std::uint8_t {
    reached,               ///< the mean over fresh packings is within the tolerance
    reached_within_error,  ///< outside the tolerance, but the scatter of both means explains the deviation
    missed,
    out_of_reach,  ///< near the best point, no values within the bounds reach this target together with the others
    not_found,     ///< the search ended without a solution; another start may lead to one
    unresolved,    ///< too few fresh packings have results for all targets
};
constexpr auto list_names(TargetVerdict) {
    return in_order("reached", "reached within its error", "missed", "out of reach", "not found", "unresolved");
}

/// The means measured for a target, and the verdict on it.
struct ReachedTarget {
    /// Mean over the fresh packings that have results for all targets; none of them was used for fitting.
    MeanFigure fresh;
    MeanFigure polish;  ///< mean of the figure over the packings used for the last correction, before that correction
    double off = 0.0;   ///< mean over fresh packings divided by the target value, minus 1
    /// Tolerance, or half the width of the 95 % confidence interval of the difference between the two means if that is
    /// larger.
    double limit = 0.0;
    TargetVerdict verdict = TargetVerdict::missed;
    /// Number of fresh packings without a result because the stress was still increasing at the end of the test.
    std::int64_t without_peak = 0;

    /// Whether the target counts as reached, either within the tolerance or within the scatter of both means.
    bool reached() const { return verdict == TargetVerdict::reached || verdict == TargetVerdict::reached_within_error; }
};

/// State at the end of the search, as far as the verdict on a target depends on it.
struct SearchEnd {
    bool enough = true;        ///< whether enough fresh packings have results for all targets
    bool within_reach = true;  ///< whether the surfaces predict that the target is reached at the solution
    bool at_rest = true;       ///< whether no further step improves the solution
};

/// Sets the verdict of a target whose two means are known.
/// @param tolerance  allowed deviation, relative to `value`
void judge(ReachedTarget& target, double value, double tolerance, const SearchEnd& end);

}  // namespace crackle
