// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/allocation_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Validates a scene and builds a world from it. @throws InputError if the scene is not valid, or if the time step is
/// above the stable bound; the message then states both values
World build_world(Scene scene);

}  // namespace crackle
