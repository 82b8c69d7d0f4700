// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Checks the state of a run. @throws UnstableRun if a value is NaN, energy grows without a source, or a body has left
/// the domain
void check_health(World& world);

}  // namespace crackle
