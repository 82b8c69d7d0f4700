// SPDX-License-Identifier: GPL-3.0-or-later
// Loading by lateral strain: a compressed specimen widens steadily, and the platen does what that takes, backwards
// where the specimen gives off more energy than it needs to break (class II, Wawersik & Fairhurst, Int. J. Rock Mech.
// Min. Sci. 7, 1970).
//
// The lateral strain is that of the medians of both sides, smoothed over a transit. A target grows by ν·(the rate that
// the tolerance allows), ν of the linear solution, and lies never farther from the lateral strain, ahead or behind,
// than a band b = ν·ε1/20; the speed is that rate times (target - lateral strain)/b. An elastic specimen is loaded as
// by axial strain, b behind; where one widens faster than that the platen goes back until it no longer does.
//
// Tested by tests/specimens/loading/lateral_control_test.cpp.
#pragma once

#include "specimens/case/test_case.hpp"
#include "specimens/setup/loading_path.hpp"

namespace crackle {

struct LateralRule {
    double ratio = 0.0;         ///< Poisson's, of the linear solution; 0: not so controlled
    double band = 0.0;          ///< of lateral strain
    double acceleration = 0.0;  // 1/s2, of the axial strain

    bool on() const { return ratio > 0.0; }
};
/// @throws InputError if the specimen does not widen by the linear solution
LateralRule lateral_rule_of(const TestCase& test, const RateRule& rate, double poissons_ratio);

/// The coming speed, taken into the path. @param allowed 1/s, by the tolerance
/// @param lateral_strain now, not smoothed @param since s, since the last time
void follow_lateral(LoadingPath& path, const LateralRule& rule, double allowed, double strain, double lateral_strain,
                    double since);

}  // namespace crackle
