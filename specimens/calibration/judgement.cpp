// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/judgement.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {

void judge(ReachedTarget& target, double value, double tolerance, const SearchEnd& end) {
    target.off = target.fresh.mean / value - 1.0;
    const double chance = difference_half_width(target.fresh, target.polish) / value;
    target.limit = std::isfinite(chance) ? std::max(tolerance, chance) : tolerance;
    if (!end.enough)
        target.verdict = TargetVerdict::unresolved;
    else if (std::abs(target.off) <= tolerance)
        target.verdict = TargetVerdict::reached;
    else if (!end.within_reach)  // even if the scatter between packings could explain the deviation
        target.verdict = end.at_rest ? TargetVerdict::out_of_reach : TargetVerdict::not_found;
    else
        target.verdict =
            std::abs(target.off) <= target.limit ? TargetVerdict::reached_within_error : TargetVerdict::missed;
}

}  // namespace crackle
