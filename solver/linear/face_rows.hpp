// SPDX-License-Identifier: GPL-3.0-or-later
// Represents the faces of a world by rows of linear springs about the current positions. Each face has three rows, for
// its springs and dashpots, and each cell with a pressure has one.
//
// A time step that is stable for the rows of all faces is stable for every later state of the same faces, since breaks
// only reduce stiffness. The late pressures used for broken faces add no stiffness.
//
// Broken faces, such as those of a notch, are left out of a linear solution. The two cells beside such a face move
// freely there under their pressure p, by s² L² p/k_n each. The effect of one cell's pressure on the other is ignored.
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include "solver/linear/linear_rows.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// The faces that have rows.
enum class FacesWithRows { all, intact };

/// Rows of springs of the faces at the current positions. Empty without faces. @param which all faces as if none were
/// broken, or those that are intact or lie in joints which loading presses together
LinearRows face_rows(const World& world, FacesWithRows which);

/// Elastic forces (N) and moments (N m) of all faces of a world for small motions of its bodies, 0 for faces without
/// rows in FacesWithRows::intact.
std::vector<FaceForces> face_force_rates(const World& world, const std::vector<BodyMotion>& motion);

}  // namespace crackle
