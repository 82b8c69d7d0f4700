// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle {

/// A scene without bodies and walls, with a single material.
inline Scene open_scene(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.domain.wall_present = {false, false, false, false};
    return scene;
}

}  // namespace crackle
