// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that have been pressed through one another. The distance from an open segment has no sign, so that a circle or
// corner that got past the middle is pushed out behind; a corner deep in an outline is pushed out at the nearest side,
// whichever it came by. Energy is kept all the while, so no other check would notice.
// Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Compares places now with those when the list was built: a circle or corner on the other side of a segment, or the
/// centroid of a convex body inside an outline that it was outside of. To be called before the list is built again,
/// which is before anything has moved a tenth of a body's size. The rounded law only: the guide's lets discs through by
/// its own rules. Two circles are not looked at, packing presses them deep, nor two
/// bodies that are held: they go where they are told to.
/// @throws UnstableRun naming both bodies (not with allow_unstable)
void refuse_piercing(const World& world);

}  // namespace crackle
