// SPDX-License-Identifier: GPL-3.0-or-later
// in_cf.dat and in_cf0.dat: state of the contacts (shear springs, bonds), and back-tensions. Formats: FORMATS.md.
//
// A contact point is identified by its two bodies and their elements. Circles and corners are numbered from 1 as in
// in_gm.dat; 0 denotes a body's whole outline, or a wall. The walls are bodies -1 (left), -2 (right), -3 (bottom) and
// -4 (top).
// Tested by tests/solver/demseg/files_test.cpp.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "solver/world/world.hpp"

namespace crackle {

class DeckReader;

/// Writes in_cf.dat: shear force, back-tension and slid flag of every point that touches or is bonded. Call this before
/// the force pass at the current positions: the next force pass of a continued run starts from these spring forces and
/// positions.
/// @param scene determines the order of the bodies
void write_contacts(std::ostream& out, const Scene& scene, const World& world);
/// Reads in_cf.dat and restores its contacts and bonds in a newly built world. A point may be listed under either of
/// its bodies. An unbonded point that the world does not contain is ignored if it may have opened by more than the
/// neighbour-list skin in the last step.
/// @throws InputError if any other listed point does not exist, if a point is listed twice, or if a contact with a wall
/// is bonded
void read_contacts(DeckReader& reader, const Scene& scene, World& world);

/// Writes in_cf0.dat: for each body, the back-tensions -k_n δ0 of its contacts. Without bonds, writes the back-tensions
/// that bonding at the current overlaps would give.
void write_back_tensions(std::ostream& out, const Scene& scene, const World& world);
/// Bonds a newly built world with δ0 = -f_b/k_n. Every bond must be in the lists of both bodies, with the same value.
void read_back_tensions(DeckReader& reader, const Scene& scene, World& world);

/// Input id of a body, or the negative number of a wall.
int partner_id(const World& world, PointKind kind, const ContactPoint& point);

}  // namespace crackle
