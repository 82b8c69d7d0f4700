// SPDX-License-Identifier: GPL-3.0-or-later
// Loading that is interrupted: at listed strains or stresses the specimen is unloaded to a share of the stress there
// and loaded again (damage-controlled tests, Martin & Chandler, Int. J. Rock Mech. Min. Sci. 31, 1994).
//
// Before a turn that is a strain d away, the speed is at most sqrt(1.4·a·d), a as in loading_path.hpp; where a stress
// says where to turn, d = (difference of stress)/E, which a damaged specimen, softer than that, reaches later.
//
// Tested by tests/specimens/loading/unloading_test.cpp.
#pragma once

#include <vector>

#include "specimens/case/test_case.hpp"
#include "specimens/setup/loading_path.hpp"

namespace crackle {

struct UnloadRule {
    bool by_strain = false;
    std::vector<double> at;     ///< strains, or N/m; positive in the sense of the test; none: loading goes on
    double to = 0.0;            ///< share of the stress where unloading began
    double acceleration = 0.0;  // 1/s2, of the strain
    double modulus = 0.0;       // N/m, of the linear solution
    /// 1/s, at least, so that every turn is come to: stopping from it takes next to no way.
    double creep = 0.0;

    bool on() const { return !at.empty(); }
    /// Strain that unloading and loading again take at most, of an elastic specimen. @param strain that it is loaded to
    double added_travel(double strain) const;
};
UnloadRule unload_rule_of(const TestCase::Loading& loading, const RateRule& rate, double modulus);

/// 1/s, to begin with: from it there is the way to stop before the first turn. @param allowed 1/s
double first_speed(const UnloadRule& rule, double allowed);

/// The coming speed, taken into the path. @param allowed 1/s, by the tolerance
/// @param strain, stress now, positive in the sense of the test @param since s, since the last time
void turn_by_list(LoadingPath& path, const UnloadRule& rule, double allowed, double strain, double stress,
                  double since);

}  // namespace crackle
