// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the points of a membrane by rolling a probe disc around the bodies: on each side from the lower to the upper
// platen, or once around all bodies. The points are those that the disc touches.
//
// The disc's radius determines which gaps the membrane enters: wherever the disc fits between two bodies, so does the
// membrane. The result is the boundary of an alpha shape (Edelsbrunner, Kirkpatrick & Seidel, IEEE Trans. Inf. Theory
// 29, 1983). Membrane points are centres of circles, or points on the outlines of polygons with a spacing of at most
// the disc's radius. Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Wraps a membrane around the bodies. @param pressure N/m @param probe m, radius of the rolled disc
/// @param bottom, top the platens; no_body if the membrane encloses all bodies
/// @throws InputError if the disc can pass between the platens from one side of the specimen to the other
void add_membrane(World& world, double pressure, double probe, BodyIndex bottom = no_body, BodyIndex top = no_body);

/// Wraps the membrane again if a piece has become too long or the neighbour list was rebuilt. If the disc can pass from
/// one side to the other, the old points are kept and the failure is counted.
void update_membrane(World& world);

}  // namespace crackle
