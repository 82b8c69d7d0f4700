// SPDX-License-Identifier: GPL-3.0-or-later
// A material and a scene for specimens made in memory.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle {

/// A rock without dashpots, with density 2500 kg/m2 as in the DEMseg guide's example.
/// @param normal_stiffness  k_n, N/m @param friction_angle  degrees @param shear_share  k_s/k_n
inline Material undamped_rock(double normal_stiffness, double friction_angle, double shear_share = 0.25) {
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = normal_stiffness;
    material.shear_stiffness = shear_share * normal_stiffness;
    material.friction_angle = friction_angle;
    return material;
}

/// A scene without bodies and walls, with a single material.
inline Scene open_scene(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.domain.wall_present = {false, false, false, false};
    return scene;
}

}  // namespace crackle
