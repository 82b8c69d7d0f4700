// SPDX-License-Identifier: GPL-3.0-or-later
// A platen that may turn round: its speed, and the way it has gone.
//
// The speed changes by no more than makes the two platens' stresses differ by the tolerance: an acceleration a of the
// strain makes them differ by ρ·height²·a/2 = E·T²·a/2, T the transit of a wave, so a = 2·tolerance·ε1/T² (ε1 and T as
// in loading_rate.hpp).
// Tested by tests/specimens/loading/unloading_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "specimens/setup/loading_rate.hpp"

namespace crackle {

/// Where loading stands. Of a platen that only goes forward no more than the farthest strain is used.
struct LoadingPath {
    double speed = 0.0;           // 1/s, of the strain, negative while the platen goes back
    double chosen_at = 0.0;       // s, when it was chosen last
    double turned_at = 0.0;       ///< strain where it last turned round
    double travelled = 0.0;       ///< strain gone through until then, back and forth
    bool unloading = false;       // unloading.hpp
    std::int64_t unloaded = 0;    ///< times that unloading has begun
    double stress_at_turn = 0.0;  // N/m, where it last did
    double lateral = std::numeric_limits<double>::quiet_NaN();   ///< strain, smoothed: lateral_control.hpp
    double lateral_target = 0.0;                                 // lateral_control.hpp
    double own_from = std::numeric_limits<double>::infinity();   ///< way gone when a caller took over the speed
    double farthest = -std::numeric_limits<double>::infinity();  ///< strain of the rows so far

    /// Strain gone through, back and forth: the strain itself where nothing turns.
    double travel(double strain) const {
        return travelled + (std::signbit(speed) ? turned_at - strain : strain - turned_at);
    }
    bool by_caller() const { return std::isfinite(own_from); }
    /// Takes the coming speed, as near to what is wanted as the change allows. @param strain now
    void change_speed(double wanted, double most_change, double strain);

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("speed", s.speed);
        visit("chosen_at", s.chosen_at);
        visit("turned_at", s.turned_at);
        visit("travelled", s.travelled);
        visit("unloading", s.unloading);
        visit("unloaded", s.unloaded);
        visit("stress_at_turn", s.stress_at_turn);
        visit("lateral", s.lateral);
        visit("lateral_target", s.lateral_target);
        visit("own_from", s.own_from);
        visit("farthest", s.farthest);
    }
};

/// a, 1/s2
double largest_acceleration(const RateRule& rule);

}  // namespace crackle
