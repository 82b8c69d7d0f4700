// SPDX-License-Identifier: GPL-3.0-or-later
// Represents the faces of a world, as if none were broken, by rows of linear springs about the current positions. Each
// face has three rows, for its springs and dashpots, and each cell with a pressure has one.
//
// A time step that is stable for these rows is stable for every later state of the same faces, since breaks only reduce
// stiffness. The late pressures used for broken faces add no stiffness.
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include "solver/linear/linear_rows.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Rows of springs for all faces at the current positions, as if none were broken. Empty without faces.
LinearRows face_rows(const World& world);

/// Elastic forces (N) and moments (N m) of all faces of a world for small motions of its bodies, as if no face were
/// broken.
std::vector<FaceForces> face_force_rates(const World& world, const std::vector<BodyMotion>& motion);

}  // namespace crackle
