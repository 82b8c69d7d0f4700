// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of an intact world as rows of its stiffness matrix, linearised about the current positions. There are three
// for the springs of each face, with their dashpots, and one for the pressure of each cell.
//
// The stable step of these rows bounds that of every later state of the same faces: breaks only soften. Pressures that
// broken faces take from the step before add no stiffness.
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include "solver/linear/linear_rows.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Rows of all faces of a world as if none were broken, at the current positions of the bodies. Empty without faces.
LinearRows face_rows(const World& world);

/// Elastic forces of all faces of a world for small motions of its bodies, as if none were broken: N, N, N m.
std::vector<FaceForces> face_force_rates(const World& world, const std::vector<BodyMotion>& motion);

}  // namespace crackle
