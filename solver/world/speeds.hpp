// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <algorithm>
#include <limits>

namespace crackle {

/// Largest squared surface speed of some bodies, m2/s2.
struct Speeds {
    double fastest = 0.0;
    double sum_of_excess = 0.0;  // 0·speed, added up: 0, or not a number if any speed is infinite or none

    void add(double squared) {
        sum_of_excess += 0.0 * squared;
        fastest = std::max(fastest, squared);
    }
    void add(const Speeds& others) {
        sum_of_excess += others.sum_of_excess;
        fastest = std::max(fastest, others.fastest);
    }
    /// @return `fastest`, not a number if any speed is not
    double checked() const { return sum_of_excess == 0.0 ? fastest : std::numeric_limits<double>::quiet_NaN(); }
};

}  // namespace crackle
