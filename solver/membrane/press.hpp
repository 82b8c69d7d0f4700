// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of a membrane on the bodies that it touches.
//
// The membrane is a chain of straight pieces that runs clockwise around the bodies. Each end of a piece from a to b
// receives half of the inward pressure force on the piece:
//     f = ½ p (b.y - a.y, a.x - b.x)
// A point between a and c therefore receives ½ p rot(c - a). This is minus the gradient of p times the enclosed area,
// which is quadratic in the positions. Hence, by the trapezoidal rule, the work of the forces over a step is -p ΔA up
// to round-off, as long as the points of the chain stay the same. The area swept by the faces of platens is subtracted
// from A. Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Adds the membrane's forces to Bodies::force and its work to the energy account. Call it after clearing the forces
/// and before the force pass.
void press_membrane(World& world);

/// Area enclosed by the chains at the current positions, minus the area swept by the platens (Membrane::area), m².
double membrane_area(const World& world);

/// Current force of the membrane on a body; zero without a membrane.
BodyForce membrane_force_on(const World& world, BodyIndex body);

}  // namespace crackle
