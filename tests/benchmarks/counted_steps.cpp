// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of a small scene for instruction_counts to count. Arguments: scene, steps.

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "solver/world.hpp"
#include "specimens/catalogue/lattices.hpp"
#include "specimens/catalogue/materials.hpp"

namespace crackle {
namespace {

Material rock(double damping_ratio) {
    Material material = undamped_rock(1e7, 27.0);
    material.damping_ratio = damping_ratio;
    return material;
}

/// Every body gets a velocity of its own, small enough that nothing breaks.
void stir(Scene& scene, double speed) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b);
        scene.bodies[b].velocity = {speed * std::sin(1.7 * k), speed * std::cos(2.3 * k)};
    }
}

World bonded_discs() {
    Scene scene = triangular_lattice(18, 18, 0.02, 8e-5, rock(0.2));
    stir(scene, 1e-6);
    World world = build_world(scene);
    bond_all(world, 0.0);
    return world;
}

World bonded_hexagons() {
    Scene scene = honeycomb(10, 10, 0.02, 1e-3, rock(0.2));
    stir(scene, 1e-6);
    World world = build_world(scene);
    bond_all(world, 1.08e-3);
    return world;
}

/// Discs without bonds or dashpots that fly apart and meet: lists are built anew as they go.
World loose_discs() {
    Scene scene = triangular_lattice(18, 18, 0.02, -1e-3, rock(0.0));
    stir(scene, 1.0);
    scene.ledger = false;
    return build_world(scene);
}

}  // namespace
}  // namespace crackle

int main(int count, char** words) {
    using namespace crackle;
    const std::string scene = count > 1 ? words[1] : "";
    const long steps = count > 2 ? std::atol(words[2]) : 0;
    if (count != 3 || steps < 1 || (scene != "discs" && scene != "hexagons" && scene != "loose")) {
        std::cerr << "usage: counted_steps discs|hexagons|loose STEPS\n";
        return 2;
    }
    World world = scene == "discs" ? bonded_discs() : scene == "hexagons" ? bonded_hexagons() : loose_discs();
    for (long k = 0; k < steps; ++k) step(world);
    std::cout << world.bodies.size() << '\n';
    return 0;
}
