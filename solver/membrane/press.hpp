// SPDX-License-Identifier: GPL-3.0-or-later
// What a membrane does to the bodies that it lies on.
//
// Of a piece from a to b, clockwise about the bodies, each end has half the pressure on its length, inwards:
//     f = ½ p (b.y - a.y, a.x - b.x)
// so a point between a and c has ½ p rot(c - a): minus the gradient of p times the enclosed area, which is quadratic in
// the places. The work of the forces over a step, by the trapezoidal rule, is therefore -p ΔA to rounding, as long as
// the chain stays the same. What platens sweep with their faces is not the membrane's: A is less by it.
// Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Adds the membrane's forces to Bodies::force, and its work to the account. Between clearing forces and the force
/// pass.
void press_membrane(World& world);

/// m², enclosed by the chains as the bodies lie now, less what platens sweep: Membrane::area.
double membrane_area(const World& world);

/// Of the membrane on a body now; nothing without one.
BodyForce membrane_force_on(const World& world, BodyIndex body);

}  // namespace crackle
