// SPDX-License-Identifier: GPL-3.0-or-later
// Path of a platen that may reverse: its speed and the distance it has travelled, as a strain.
//
// Speed changes are limited so that the stresses at the two platens differ by at most tolerance·E·ε1. A strain
// acceleration a makes them differ by ρ·height²·a/2 = E·T²·a/2, where T is the transit time of a wave. Hence a =
// 2·tolerance·ε1/T² (ε1 and T as in loading_rate.hpp).
// Tested by tests/specimens/loading/unloading_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/base/fields.hpp"
#include "specimens/setup/loading_rate.hpp"

namespace crackle {

/// Current state of the path. If the platen only moves forward, only `farthest` is used.
struct LoadingPath {
    double speed = 0.0;           // 1/s, strain rate; negative while the platen moves back
    double chosen_at = 0.0;       // s, time at which the speed was last chosen
    double turned_at = 0.0;       ///< strain at the last reversal
    double travelled = 0.0;       ///< strain travelled, back and forth, up to the last reversal
    bool unloading = false;       // whether the specimen is being unloaded (unloading.hpp)
    std::int64_t unloaded = 0;    ///< number of unloadings started
    double stress_at_turn = 0.0;  // N/m, stress at the last reversal
    double lateral = std::numeric_limits<double>::quiet_NaN();  ///< smoothed lateral strain, see lateral_control.hpp
    double lateral_target = 0.0;                                // target of the lateral strain
    double own_from =
        std::numeric_limits<double>::infinity();  ///< strain travelled when the caller took over the speed, or infinity
    double farthest = -std::numeric_limits<double>::infinity();  ///< largest strain in the curve rows so far

    /// Total strain travelled, back and forth; equal to the strain if the platen never reverses.
    double travel(double strain) const {
        return travelled + (std::signbit(speed) ? turned_at - strain : strain - turned_at);
    }
    /// Whether the caller has taken over the platen's speed.
    bool by_caller() const { return std::isfinite(own_from); }
    /// Sets the next speed as close to `wanted` as `most_change` allows. @param strain  current strain
    void change_speed(double wanted, double most_change, double strain);

    CRACKLE_FIELDS(speed, chosen_at, turned_at, travelled, unloading, unloaded, stress_at_turn, lateral, lateral_target,
                   own_from, farthest);
};

/// Largest acceleration of the strain, a, 1/s2.
double largest_acceleration(const RateRule& rule);

}  // namespace crackle
