// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds that the last force pass found broken become events.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Appends one event a broken bond in the order of the points, books its energy and releases the point.
void record_breaks(World& world);

}  // namespace crackle
