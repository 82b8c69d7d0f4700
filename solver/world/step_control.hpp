// SPDX-License-Identifier: GPL-3.0-or-later
// Simulated time and time step of a world, and the bounds on the time step.
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/bodies.hpp"

namespace crackle {

/// Fraction of the stable bound used for an automatic time step in a world without bonds, where contacts open and
/// close. Leapfrog applies these changes at the end of a step, which causes an energy error that grows with the square
/// of the step. In the reference test, the DEMseg guide's circle bounces 20 times without losses; 2 % accuracy is
/// required. The largest energy error, relative to the energy of the fall, is 9.3 % at a fraction of 0.2, 1.7 % at 0.1
/// and 0.45 % at 0.05. At 0.8 the circle flies off.
inline constexpr double loose_step_share = 0.1;

/// Clock of a run, and values that determine the time step.
struct StepControl {
    std::int64_t steps = 0;       // number of steps completed
    double time = 0.0;            // s
    double time_step = 0.0;       // s
    double drift = 0.0;           // s, length of the drift that led to the current positions (0 before the first)
    double kick_share = 0.5;      // fraction of a full kick in the next step; 0.5 for the first kick of leapfrog
    bool forces_current = false;  // whether forces have been computed for the current positions
    bool points_gained = false;   // whether points that are not yet counted in step_bound have begun to carry load

    bool automatic_step =
        false;                // whether the step is computed by the program and may be lowered when the list is rebuilt
    double step_scale = 1.0;  // factor on automatic time steps
    double safety_factor = 0.8;
    double step_bound = std::numeric_limits<double>::infinity();  // s, guaranteed stable step for the counted points
    BodyIndex limiting_body = 0;                                  // body that determines step_bound
    std::vector<double> step_weights;                             // for each body; see linear/step_bound.cpp
    double weighed_bound = 0.0;        // s, value of step_bound when step_weights were computed
    std::uint64_t weighed_points = 0;  // number of listed points when step_weights were computed
    double exact_step = 0.0;           // s, exact stable step when bonds were made; 0 before bonding
    bool exact_step_proved = false;
    // Value to which an automatic step returns, s: safety_factor times exact_step; 0 if the world has no bonds or the
    // step is given.
    double step_goal = 0.0;
    bool allow_unstable = false;

    CRACKLE_FIELDS(steps, time, time_step, drift, kick_share, forces_current, points_gained, automatic_step, step_scale,
                   safety_factor, step_bound, limiting_body, step_weights, weighed_bound, weighed_points, exact_step,
                   exact_step_proved, step_goal, allow_unstable);
};

/// Part of the next kick that lies before time n, s: half the previous drift. It is 0 for a start with a half kick, and
/// half the next drift if a deck starts with a full kick. A kick extends from the middle of one drift to the middle of
/// the next, even if their lengths differ.
inline double kick_before(const StepControl& control) {
    if (control.kick_share < 1.0) return 0.0;
    return 0.5 * (control.drift > 0.0 ? control.drift : control.time_step);
}

}  // namespace crackle
