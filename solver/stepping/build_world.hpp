// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/allocation_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Validates the scene and lays it out. @throws InputError (a time step above the bound included, naming both).
World build_world(Scene scene);

}  // namespace crackle
