// SPDX-License-Identifier: GPL-3.0-or-later
// Moves bodies by the displacements of a linear solution before loading starts.
// Tested by tests/specimens/loading/confine_test.cpp.
#pragma once

#include <vector>

#include "solver/linear/elastic.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Moves all bodies, including platens, and updates the shear springs, in steps of the integrator without forces. Each
/// step moves bodies by at most a tenth of the displacement allowed in a step. All velocities are 0 afterwards; time
/// and step number do not change.
/// @param way  displacement of each body, m and rad
void displace(World& world, const std::vector<BodyMotion>& way);

/// Sets the velocities of all bodies, including platens, to `motion` multiplied by `times`.
/// @param motion  displacement of each body, m and rad
/// @param times  1/s
void set_velocities(World& world, const std::vector<BodyMotion>& motion, double times);

}  // namespace crackle
