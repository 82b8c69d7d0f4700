// SPDX-License-Identifier: GPL-3.0-or-later
// How far a world has come in time, how long its step is, and why.
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "solver/world/bodies.hpp"

namespace crackle {

/// Share of the stable bound that a derived step takes in a world without bonds, where contacts open and close.
/// Leapfrog has this happen at the end of a step and errs in energy by what grows with its square: the guide's circle,
/// bouncing 20 times without losses, has a largest closing error of 9.3 % of the energy of the fall at 0.2, 1.7 % at
/// 0.1 and 0.45 % at 0.05, and flies off at 0.8. Asked for: 2 %.
inline constexpr double loose_step_share = 0.1;

struct StepControl {
    std::int64_t steps = 0;       // done
    double time = 0.0;            // s
    double time_step = 0.0;       // s
    double drift = 0.0;           // s, length of the drift that led to the present positions (0 before the first)
    double kick_share = 0.5;      // share of a full kick in the next step: the first kick of leapfrog
    bool forces_current = false;  // the force pass at the present positions is done
    bool points_gained = false;   // some came to carry load: they are counted in step_bound before the next force pass

    bool automatic_step = false;  // may be lowered when the list is rebuilt
    double step_scale = 1.0;      // of derived steps
    double safety_factor = 0.8;
    double step_bound = std::numeric_limits<double>::infinity();  // s, guaranteed stable below, of the counted points
    BodyIndex limiting_body = 0;                                  // sets step_bound
    std::vector<double> step_weights;                             // per body, see linear/step_bound.cpp
    double weighed_bound = 0.0;                                   // s, step_bound when step_weights were found
    std::uint64_t weighed_points = 0;                             // listed then
    double exact_step = 0.0;  // s, exact stable step when bonds were made; 0: no bonds yet
    bool exact_step_proved = false;
    double step_goal = 0.0;  // s, what a derived step goes back to: safety_factor times the exact one; 0: none
    bool allow_unstable = false;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("steps", s.steps);
        visit("time", s.time);
        visit("time_step", s.time_step);
        visit("drift", s.drift);
        visit("kick_share", s.kick_share);
        visit("forces_current", s.forces_current);
        visit("points_gained", s.points_gained);
        visit("automatic_step", s.automatic_step);
        visit("step_scale", s.step_scale);
        visit("safety_factor", s.safety_factor);
        visit("step_bound", s.step_bound);
        visit("limiting_body", s.limiting_body);
        visit("step_weights", s.step_weights);
        visit("weighed_bound", s.weighed_bound);
        visit("weighed_points", s.weighed_points);
        visit("exact_step", s.exact_step);
        visit("exact_step_proved", s.exact_step_proved);
        visit("step_goal", s.step_goal);
        visit("allow_unstable", s.allow_unstable);
    }
};

/// Part of the coming kick that lies before time n, s: half of the drift that led here (of the coming one where a deck
/// starts with a full kick), nothing at a half-kick start. Kicks join the middles of drifts, whatever their lengths.
inline double kick_before(const StepControl& control) {
    if (control.kick_share < 1.0) return 0.0;
    return 0.5 * (control.drift > 0.0 ? control.drift : control.time_step);
}

}  // namespace crackle
