// SPDX-License-Identifier: GPL-3.0-or-later
// Loading with unloading cycles: at listed strains or stresses the specimen is unloaded to a fraction of the stress
// reached, and then reloaded (damage-controlled tests, Martin & Chandler, Int. J. Rock Mech. Min. Sci. 31, 1994).
//
// At a strain distance d before a reversal the speed is at most sqrt(1.4·a·d), with a as in loading_path.hpp. If a
// stress defines the reversal, d = (stress difference)/E; a damaged specimen is softer and reaches it later.
//
// Tested by tests/specimens/loading/unloading_test.cpp.
#pragma once

#include <vector>

#include "specimens/parts/loading.hpp"
#include "specimens/setup/loading_path.hpp"

namespace crackle {

/// Where loading reverses, and how fast.
struct UnloadRule {
    bool by_strain = false;
    std::vector<double> at;     ///< strains, or stresses in N/m; positive as in loading; empty: no unloading
    double to = 0.0;            ///< unloading ends at this fraction of the stress at which it started
    double acceleration = 0.0;  // 1/s2, largest acceleration of the strain
    double modulus = 0.0;       // modulus from the linear solution, N/m
    /// Smallest speed, 1/s, so that every reversal is reached; the distance needed to stop from it is negligible.
    double creep = 0.0;

    /// Whether the test unloads.
    bool on() const { return !at.empty(); }
    /// Largest cumulative absolute strain that the unloading cycles of an elastic specimen add to a test.
    /// @param strain  largest strain of the test
    double added_travel(double strain) const;
};
/// @param modulus  modulus from the linear solution, N/m
UnloadRule unload_rule_of(const parts::Unloading& asked, const RateRule& rate, double modulus);

/// Initial speed, 1/s, from which the platen can still stop before the first reversal. @param allowed  1/s, strain rate
/// allowed by the tolerance
double first_speed(const UnloadRule& rule, double allowed);

/// Chooses the next speed and stores it in the path. @param allowed  1/s, strain rate allowed by the tolerance
/// @param strain, stress  current values, positive in the direction of loading @param since  s, time since the last
/// call
void turn_by_list(LoadingPath& path, const UnloadRule& rule, double allowed, double strain, double stress,
                  double since);

}  // namespace crackle
