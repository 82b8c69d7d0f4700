// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list: all contact points that could come into contact before a body has moved by half the skin.
//
// In a bonded world the skin is as narrow as the motion allows, so that the list holds few points that never touch.
// Such points are frequent in a mesh, where corners face each other across a gap. A fast body has a wider skin than the
// others; otherwise a few flying fragments would cause a rebuild every few steps. The list depends only on positions
// and on the step count, not on the number of threads.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Rebuilds the neighbour list if a body has moved by half the skin since the last build, or if the list is invalid.
/// After a rebuild the bound on the time step must be computed again (stepping/time_step.hpp). @return whether the list
/// was rebuilt @throws UnstableRun if one body was pressed through another (pierced.hpp)
bool update_neighbour_list(World& world);

}  // namespace crackle
