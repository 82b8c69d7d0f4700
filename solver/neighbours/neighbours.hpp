// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list: every contact point that could close before something has moved half the skin.
//
// In a bonded world the skin is as narrow as the motion allows, so that points which nothing brings together cost
// nothing: a mesh has many corners that face each other over a gap. A body that is fast beyond that has a wider skin of
// its own: a few fragments in flight, or a flow, would have the list rebuilt every few steps. Everything depends on
// positions and steps alone, never on the number of threads.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Rebuilds the list if something has moved half the skin since it was built (always when it is not valid). The bound
/// on the step then has to be found again (stepping/time_step.hpp). @return whether it was rebuilt
/// @throws UnstableRun if bodies were pressed through one another (pierced.hpp)
bool update_neighbour_list(World& world);

}  // namespace crackle
