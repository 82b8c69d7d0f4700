// SPDX-License-Identifier: GPL-3.0-or-later
// The bonds of a world in numbers, and those that broke.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/vec2.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// One broken bond.
struct BreakEvent {
    std::int64_t step;
    double time;             // s
    int body_i, body_j;      // input ids
    Vec2 position;           // m
    double orientation;      // rad, direction of the contact normal, in (-π/2, π/2]
    double energy;           // J: taken by the break, stepping/record_breaks.cpp
    double strength;         // N: k_n δ0; of a coulomb bond the limit that it met, T or C + μ f_n
    double normal_force;     // N, of Points::strong_normal; of a coulomb bond those that it failed under
    double shear_force;      // N
    bool slid;               // back-tension only
    bool shear_mode;         // slid and |f_t| > |f_n|, of a coulomb bond by the limit met first; else tension
    bool last_of_interface;  // no bonded point is left between the two bodies
    PointKind kind;          // of the point
    ContactPoint point;      // by internal numbers, for readers that keep books by points

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("step", s.step);
        visit("time", s.time);
        visit("body_i", s.body_i);
        visit("body_j", s.body_j);
        visit("position", s.position);
        visit("orientation", s.orientation);
        visit("energy", s.energy);
        visit("strength", s.strength);
        visit("normal_force", s.normal_force);
        visit("shear_force", s.shear_force);
        visit("slid", s.slid);
        visit("shear_mode", s.shear_mode);
        visit("last_of_interface", s.last_of_interface);
        visit("kind", s.kind);
        visit("point", s.point);
    }
};

/// First arrival of a back-tension bond at its Coulomb limit.
struct SlipEvent {
    std::int64_t step;
    double time;                       // s
    int body_i, body_j;                // input ids
    Vec2 position;                     // m
    double orientation;                // rad, as a break's
    double normal_force, shear_force;  // N, elastic, at the limit

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("step", s.step);
        visit("time", s.time);
        visit("body_i", s.body_i);
        visit("body_j", s.body_j);
        visit("position", s.position);
        visit("orientation", s.orientation);
        visit("normal_force", s.normal_force);
        visit("shear_force", s.shear_force);
    }
};

struct Bonds {
    bool made = false;  // bonding is done, whether it found points to bond or not
    std::int64_t initial = 0, broken = 0;
    std::int64_t held = 0;  // of the initial ones, that cannot break
    std::int64_t broken_after_sliding = 0;
    std::int64_t interfaces_initial = 0, interfaces_lost = 0;
    std::vector<BreakEvent> events;  // broken bonds; readers may clear it
    bool watch_slips = false;
    std::vector<SlipEvent> slips;  // where watched; readers may clear it

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("made", s.made);
        visit("initial", s.initial);
        visit("broken", s.broken);
        visit("held", s.held);
        visit("interfaces_initial", s.interfaces_initial);
        visit("interfaces_lost", s.interfaces_lost);
        visit("events", s.events);
        visit("watch_slips", s.watch_slips);
        visit("slips", s.slips);
        visit("broken_after_sliding", s.broken_after_sliding);
    }
};

}  // namespace crackle
