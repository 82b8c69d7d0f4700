// SPDX-License-Identifier: GPL-3.0-or-later
// Labels of minerals, one per grain, for four grains.

#include "specimens/making/minerals.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::labels(std::string_view bytes) {
    Scene scene;
    Material material;
    material.density = 1.0;
    scene.materials.assign(2, material);
    for (int id = 1; id <= 4; ++id) scene.add_circle_body(id, 0, {{2.0 * id, 0.0}, 1.0});
    parts::Minerals minerals;
    minerals.list = {{"quartz", {}, {}, 0.0}, {"mica", {}, {}, 0.0}};
    minerals.assign = parts::GrainLabels{scratch() / "labels.txt"};
    write_file("labels.txt", bytes);
    std::vector<std::string> notices;
    assign_minerals(scene, minerals, {}, notices);
}
