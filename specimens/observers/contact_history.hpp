// SPDX-License-Identifier: GPL-3.0-or-later
// History needed for frames: which bonded points broke and when, and since when bodies have touched without a bond.
//
// The step of each break is known exactly. Contacts are only updated at curve rows, of which a test has at least 2000,
// whether they are written to curve.csv or not. The age of a contact counts from the row in which it was first seen. A
// contact that opens and closes between two rows counts as uninterrupted. Steps between rows cost no extra time.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/world.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A bonded point that has broken.
struct Crack {
    double time = 0.0;         // s
    double energy = 0.0;       // J, energy dissipated by the break
    double strength = 0.0;     // strength, N, as in BreakEvent
    double orientation = 0.0;  // rad, direction of the contact normal when the bond broke, in (-π/2, π/2]
    PointIndex bond = 0;       // index into BondRecord::points
    bool shear_mode = false;

    CRACKLE_FIELDS(time, energy, strength, orientation, bond, shear_mode);
};

/// A contact point that touches and has no intact bond.
struct LooseContact {
    ContactPoint point;
    double shear_force = 0.0;  // N, elastic part, at the last update
    double since = 0.0;        // s, time of the row in which the contact was first seen
    /// Elastic normal force, N, at the last update, for a point across a joint or in a specimen bonded by faces. Such a
    /// point may have its own stiffness and an overlap at which the force is zero. NaN elsewhere, because the positions
    /// of the bodies then determine the force.
    double joint_force = std::numeric_limits<double>::quiet_NaN();

    CRACKLE_FIELDS(point, shear_force, since, joint_force);
};

/// Unbonded contact points that touch.
struct LooseContacts {
    std::vector<LooseContact> contacts;  ///< sorted by kind and key (point_order.hpp)
    std::array<PointIndex, point_kinds + 1> kind_begin{};

    CRACKLE_FIELDS(contacts, kind_begin);
};

/// History of the contacts in a test.
struct ContactHistory {
    std::vector<Crack> cracks;  ///< cracks in the order in which the bonds broke
    LooseContacts loose;        ///< unbonded contacts at the last update

    CRACKLE_FIELDS(cracks, loose);
};

/// Records a break.
void note_break(const BondRecord& bonds, const BreakEvent& event, ContactHistory& history);
/// Records the points that currently touch without a bond. Requires compute_forces(). The cost is proportional to the
/// number of listed points.
void look_at_contacts(const World& world, ContactHistory& history);

/// Index of a point in BondRecord::points; the size of that list if the point was not bonded at the start of loading.
PointIndex bond_of(const BondRecord& bonds, PointKind kind, const ContactPoint& point);

}  // namespace crackle
