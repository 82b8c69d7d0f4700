// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// @throws UnstableRun on a value that is not a number, runaway energy, or a body that left the world.
void check_health(World& world);

}  // namespace crackle
