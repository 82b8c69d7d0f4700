// SPDX-License-Identifier: GPL-3.0-or-later
// Whether fresh packings have what a target asks for.
//
// Keys were moved until the packings of the last correction had the target; fresh ones are others. Both means scatter,
// so they differ by chance: what counts is the error of their difference (difference_half_width()).
// Tested by tests/specimens/calibration/judgement_test.cpp.
#pragma once

#include <cstdint>

#include "specimens/statistics/mean.hpp"

namespace crackle {

enum class TargetVerdict : std::uint8_t {
    reached,               ///< the mean of fresh packings is within the tolerance
    reached_within_error,  ///< beyond it, within what both means' scatter explains
    missed,
    out_of_reach,  ///< by all that is known around the best point none within the bounds has it with the others
    not_found,     ///< the search ended on its way: another start may find it
    unresolved,    ///< too few fresh packings have the figures
};
const char* name_of(TargetVerdict verdict);  ///< "reached", "out of reach", …

struct ReachedTarget {
    MeanFigure fresh;    ///< on packings that nothing was fitted to, of those that have all targets' figures
    MeanFigure polish;   ///< on those of the last correction, before it
    double off = 0.0;    ///< mean over target, less 1
    double limit = 0.0;  ///< tolerance, or the 95 % interval of fresh less corrected mean where that is more
    TargetVerdict verdict = TargetVerdict::missed;

    bool reached() const { return verdict == TargetVerdict::reached || verdict == TargetVerdict::reached_within_error; }
};

/// What the search knows of a target beside its two means.
struct SearchEnd {
    bool enough = true;        ///< fresh packings that have all figures
    bool within_reach = true;  ///< the surfaces expect the target here
    bool at_rest = true;       ///< no step leads on
};

/// Judges a target whose two means are known. @param tolerance of its value, a share
void judge(ReachedTarget& target, double value, double tolerance, const SearchEnd& end);

}  // namespace crackle
