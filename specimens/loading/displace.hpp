// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies moved by what a linear solution says, before loading begins.
// Tested by tests/specimens/loading/confine_test.cpp.
#pragma once

#include <vector>

#include "solver/linear/elastic.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Moves the bodies, platens too, and lets the shear springs follow, in drifts of the integrator without forces: as
/// many as keep each within a tenth of what a step may move. Velocities are 0 afterwards, time and steps as before.
/// @param way m and rad, by body
void displace(World& world, const std::vector<BodyMotion>& way);

/// Sets the velocities of all bodies, platens too. @param motion by body, @param times 1/s, of it
void set_velocities(World& world, const std::vector<BodyMotion>& motion, double times);

}  // namespace crackle
