// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <algorithm>
#include <limits>

namespace crackle {

/// Largest squared surface speed of a group of bodies, m2/s2.
struct Speeds {
    double fastest = 0.0;
    double sum_of_excess = 0.0;  // sum of 0·speed: 0, or NaN if any speed is infinite or NaN

    /// Adds a body to the group. @param squared the squared surface speed of the body, m2/s2
    void add(double squared) {
        sum_of_excess += 0.0 * squared;
        fastest = std::max(fastest, squared);
    }
    /// Adds another group of bodies to this one.
    void add(const Speeds& others) {
        sum_of_excess += others.sum_of_excess;
        fastest = std::max(fastest, others.fastest);
    }
    /// @return `fastest`, or NaN if any speed is not finite
    double checked() const { return sum_of_excess == 0.0 ? fastest : std::numeric_limits<double>::quiet_NaN(); }
};

}  // namespace crackle
