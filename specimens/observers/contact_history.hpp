// SPDX-License-Identifier: GPL-3.0-or-later
// What frames record of the past: which bonded points have broken and when, and since when bodies touch without a bond.
//
// Breaks are known to the step. Contacts are looked for in the rows of the curve, of which a test has at least 2000,
// written or not: one is as old as the row that saw it first, and one that opens and closes between two rows stays the
// same contact. A step does nothing for it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "solver/world/world.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A bonded point that has broken.
struct Crack {
    double time = 0.0;         // s
    double energy = 0.0;       // J, taken by the break
    double strength = 0.0;     // N, as BreakEvent's
    double orientation = 0.0;  // rad, of the contact normal at the break, in (-π/2, π/2]
    PointIndex bond = 0;       // into TestSetup::bonds
    bool shear_mode = false;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("time", s.time);
        visit("energy", s.energy);
        visit("strength", s.strength);
        visit("orientation", s.orientation);
        visit("bond", s.bond);
        visit("shear_mode", s.shear_mode);
    }
};

/// A point that touches and is not, or no longer, bonded.
struct LooseContact {
    ContactPoint point;
    double shear_force = 0.0;  // N, elastic, when last looked at
    double since = 0.0;        // s, of the row that saw it first
    /// N, elastic, when last looked at, across a joint, where overlap without force and stiffness are the point's own;
    /// elsewhere not a number: the places of the bodies say it.
    double joint_force = std::numeric_limits<double>::quiet_NaN();

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("point", s.point);
        visit("shear_force", s.shear_force);
        visit("since", s.since);
        visit("joint_force", s.joint_force);
    }
};

struct LooseContacts {
    std::vector<LooseContact> contacts;  ///< by kind and in the order of keys (point_order.hpp)
    std::array<PointIndex, point_kinds + 1> kind_begin{};

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("contacts", s.contacts);
        visit("kind_begin", s.kind_begin);
    }
};

struct ContactHistory {
    std::vector<Crack> cracks;  ///< as they came
    LooseContacts loose;        ///< at the last look

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("cracks", s.cracks);
        visit("loose", s.loose);
    }
};

/// Notes a break.
void note_break(const TestSetup& setup, const BreakEvent& event, ContactHistory& history);
/// Notes what touches without a bond now. Needs compute_forces(). Linear in listed points.
void look_at_contacts(const World& world, ContactHistory& history);

/// Where a point stands in TestSetup::bonds; their number if it was not bonded when loading began.
PointIndex bond_of(const TestSetup& setup, PointKind kind, const ContactPoint& point);

}  // namespace crackle
