// SPDX-License-Identifier: GPL-3.0-or-later
// Detects bodies that have been pressed through each other. The distance from an open segment is unsigned, so a circle
// or corner that has crossed the segment's centre line is pushed out on the far side. A corner deep inside an outline
// is pushed out at the nearest edge, wherever it entered. Energy is conserved in both cases, so no other check detects
// them. Tested by tests/solver/neighbours/neighbours_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Compares the current positions with those at the last build of the neighbour list. It detects a circle or corner
/// that has changed to the other side of a segment, and the centroid of a convex body that has entered an outline. Call
/// this before every rebuild of the list, which happens before any body has moved by a tenth of its size. The check
/// applies only to the rounded law, since the DEMseg guide's segment law lets discs pass through. Pairs of circles are
/// skipped, because packing can press them deep into each other. Pairs of held bodies are skipped, because they move as
/// prescribed.
/// @throws UnstableRun naming both bodies, unless allow_unstable is set
void refuse_piercing(const World& world);

}  // namespace crackle
