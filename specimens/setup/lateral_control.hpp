// SPDX-License-Identifier: GPL-3.0-or-later
// Loading by lateral strain: the platen moves such that a compressed specimen widens at a steady rate. The platen moves
// back when fracture releases more energy than it consumes (class II behaviour, Wawersik & Fairhurst, Int. J. Rock
// Mech. Min. Sci. 7, 1970).
//
// The lateral strain is computed from the medians of both sides and smoothed over one wave transit. Its target grows at
// ν times the strain rate allowed by the tolerance, where ν is Poisson's ratio of the linear solution. The target stays
// within a band b = ν·ε1/20 of the lateral strain, on either side. The platen's strain rate is the allowed rate times
// (target - lateral strain)/b. An elastic specimen is loaded as under axial control, with a lag of b. If the specimen
// widens faster, the platen moves back until the widening slows down.
//
// Tested by tests/specimens/loading/lateral_control_test.cpp.
#pragma once

#include "specimens/parts/loading.hpp"
#include "specimens/places/places.hpp"
#include "specimens/setup/loading_path.hpp"

namespace crackle {

/// How the lateral strain controls the loading.
struct LateralRule {
    double ratio = 0.0;         ///< Poisson's ratio of the linear solution; 0: no lateral control
    double band = 0.0;          ///< largest distance between target and lateral strain
    double acceleration = 0.0;  // 1/s2, largest acceleration of the axial strain

    /// Whether the lateral strain controls the loading.
    bool on() const { return ratio > 0.0; }
};
/// @throws InputError if the specimen does not widen in the linear solution
LateralRule lateral_rule_of(const parts::Loading& loading, const Places& places, const RateRule& rate,
                            double poissons_ratio);

/// Chooses the next speed and stores it in the path. @param allowed  1/s, strain rate allowed by the tolerance
/// @param strain  axial strain @param lateral_strain  current value, not smoothed
/// @param since  s, time since the last call
void follow_lateral(LoadingPath& path, const LateralRule& rule, double allowed, double strain, double lateral_strain,
                    double since);

}  // namespace crackle
