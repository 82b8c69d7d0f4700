// SPDX-License-Identifier: GPL-3.0-or-later
// in_cf.dat and in_cf0.dat: what contacts remember (shear springs, bonds) and back-tensions. Formats: FORMATS.md.
//
// A contact point is named by its two bodies and their elements: circles and corners are numbered from 1 as in
// in_gm.dat, 0 stands for a body's whole outline (or for a wall). Walls are bodies -1 left, -2 right, -3 bottom, -4
// top.
// Tested by tests/solver/demseg/files_test.cpp.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "solver/world/world.hpp"

namespace crackle {

class DeckReader;

/// in_cf.dat: shear force, back-tension and slid flag of every point that touches or is bonded. Call before the force
/// pass at the present positions, so that a reader finds springs and positions as the next force pass needs them.
/// @param scene gives the order of the bodies.
void write_contacts(std::ostream& out, const Scene& scene, const World& world);
/// Enters the contacts into a freshly built world; a point may be listed from either of its bodies. @throws InputError
/// on points that do not exist or come twice, and on bonds with walls. Only a point that can have opened by more than
/// the list reaches in its last step may be missing.
void read_contacts(DeckReader& reader, const Scene& scene, World& world);

/// in_cf0.dat: per body its back-tensions -k_n δ0; of a world without bonds those its present overlaps would give.
void write_back_tensions(std::ostream& out, const Scene& scene, const World& world);
/// Bonds a freshly built world, δ0 = -f_b/k_n. Every bond must stand in the lists of both bodies, with one value.
void read_back_tensions(DeckReader& reader, const Scene& scene, World& world);

/// Input id of a body, or the negative number of a wall.
int partner_id(const World& world, PointKind kind, const ContactPoint& point);

}  // namespace crackle
