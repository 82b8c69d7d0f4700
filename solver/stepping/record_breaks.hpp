// SPDX-License-Identifier: GPL-3.0-or-later
// Records an event for each bonded point found broken in the last force pass. Faces record their own breaks
// (faces/face_pass.cpp).
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Appends one event per broken bond, in point order, adds its energy to the account, and marks the point as unbonded.
void record_breaks(World& world);

}  // namespace crackle
