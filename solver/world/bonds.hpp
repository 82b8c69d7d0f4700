// SPDX-License-Identifier: GPL-3.0-or-later
// Bond counts of a world, and lists of broken bonds and first slips.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/vec2.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// One broken bond.
struct BreakEvent {
    std::int64_t step;
    double time;          // s
    int body_i, body_j;   // input ids
    Vec2 position;        // m, position of the contact
    double orientation;   // rad, direction of the contact normal, in (-π/2, π/2]
    double energy;        // J, energy released by the break (stepping/record_breaks.cpp)
    double strength;      // N: k_n δ0, or the limit that was reached, T or C + μ f_n (for a face, times its length)
    double normal_force;  // N, from Points::strong_normal; coulomb bond or face: elastic force at failure
    double shear_force;   // N
    bool slid;            // whether the point slid before the bond broke; back-tension bonds only
    // Whether the bond broke in shear. A back-tension bond did if it had slid and |f_t| > |f_n|; a coulomb bond or a
    // face did if the shear limit was reached first.
    bool shear_mode;
    bool last_of_interface;  // whether this was the last bond between the two bodies
    PointKind kind;          // kind of the contact point
    ContactPoint point;      // the contact point with internal body indices, for observers that keep records per point

    CRACKLE_FIELDS(step, time, body_i, body_j, position, orientation, energy, strength, normal_force, shear_force, slid,
                   shear_mode, last_of_interface, kind, point);
};

/// The first time that a back-tension bond reaches its Coulomb limit.
struct SlipEvent {
    std::int64_t step;
    double time;                       // s
    int body_i, body_j;                // input ids
    Vec2 position;                     // m
    double orientation;                // rad, as in BreakEvent
    double normal_force, shear_force;  // N, elastic forces when the Coulomb limit was reached

    CRACKLE_FIELDS(step, time, body_i, body_j, position, orientation, normal_force, shear_force);
};

/// Counts and events of bonds.
struct Bonds {
    bool made = false;  // whether bonds have been made, even if no points were found to bond
    std::int64_t initial = 0, broken = 0;
    std::int64_t held = 0;  // number of initial bonds that are unbreakable
    std::int64_t broken_after_sliding = 0;
    std::int64_t interfaces_initial = 0, interfaces_lost = 0;
    std::vector<BreakEvent> events;  // broken bonds; observers may clear the list
    bool watch_slips = false;
    std::vector<SlipEvent> slips;  // first slips, if `watch_slips` is set; observers may clear the list

    CRACKLE_FIELDS(made, initial, broken, held, interfaces_initial, interfaces_lost, events, watch_slips, slips,
                   broken_after_sliding);
};

}  // namespace crackle
