// SPDX-License-Identifier: GPL-3.0-or-later
// Where a membrane lies: on what a disc touches that is rolled about the bodies, from the lower platen up on either
// side, or once around.
//
// The disc's radius says into which gaps the membrane reaches: bodies that lie so far apart that the disc passes
// between them are apart for the membrane, too (the boundary of an alpha shape: Edelsbrunner, Kirkpatrick & Seidel,
// IEEE Trans. Inf. Theory 29, 1983). Of circles the points are the centres, of polygons places on their outlines, no
// farther from each other than the disc's radius. Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Puts a membrane about the bodies. @param pressure N/m @param probe m, radius of the rolled disc
/// @param bottom, top the platens; no_body: it goes around all bodies
/// @throws InputError if the disc gets from one side to the other between the platens
void add_membrane(World& world, double pressure, double probe, BodyIndex bottom = no_body, BodyIndex top = no_body);

/// Finds the points anew where a piece has parted or the neighbour list has been built since. A disc that gets from one
/// side to the other leaves the old ones, and is counted.
void update_membrane(World& world);

}  // namespace crackle
