// SPDX-License-Identifier: GPL-3.0-or-later
// Runs steps of a small scene for instruction_counts. Arguments: scene, number of steps, and how they are computed:
//   step      by the engine in its usual way (default)
//   least     discs only: forces by the kernels compiled for the scene's features, their sums, kick and drift
//   friction, dashpots, bonds   as least, by kernels compiled for this feature as well
//   all       as least, by kernels compiled for all three

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/bench/throughput/least_step.hpp"
#include "tests/bench/throughput/walls.hpp"

namespace crackle {
namespace {

Material rock(double damping_ratio) {
    Material material = undamped_rock(1e7, 27.0);
    material.damping_ratio = damping_ratio;
    return material;
}

/// Gives every body a random velocity, small enough that nothing breaks.
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

/// Discs without bonds or dashpots that fly apart and collide; neighbour lists are rebuilt on the way.
World loose_discs() {
    Scene scene = triangular_lattice(18, 18, 0.02, -1e-3, rock(0.0));
    stir(scene, 1.0);
    return build_world(scene);
}

/// Discs pressed together between walls, with nothing but normal springs.
World springs_alone() {
    Material material = rock(0.0);
    material.friction_angle = 0.0;
    Scene scene = triangular_lattice(18, 18, 0.02, 8e-5, material);
    stir(scene, 1e-3);
    throughput::wall_in(scene, 0.0);
    return build_world(scene);
}

const std::map<std::string, World (*)()>& scenes() {
    static const std::map<std::string, World (*)()> all{
        {"discs", bonded_discs}, {"hexagons", bonded_hexagons}, {"loose", loose_discs}, {"springs", springs_alone}};
    return all;
}

const std::map<std::string, std::vector<bool ContactFeatures::*>>& kernels() {
    using F = ContactFeatures;
    static const std::map<std::string, std::vector<bool F::*>> all{{"friction", {&F::friction}},
                                                                   {"dashpots", {&F::damping}},
                                                                   {"bonds", {&F::bonds}},
                                                                   {"all", {&F::friction, &F::damping, &F::bonds}}};
    return all;
}

}  // namespace
}  // namespace crackle

int main(int count, char** words) {
    using namespace crackle;
    const std::string scene = count > 1 ? words[1] : "", how = count > 3 ? words[3] : "step";
    const long steps = count > 2 ? std::atol(words[2]) : 0;
    const bool known = how == "step" || how == "least" || kernels().contains(how);
    if (count < 3 || count > 4 || steps < 1 || !scenes().contains(scene) || !known) {
        std::cerr << "usage: counted_steps discs|hexagons|loose|springs STEPS [HOW]\n";
        return 2;
    }
    World world = scenes().at(scene)();
    if (how == "step") {
        for (long k = 0; k < steps; ++k) step(world);
    } else {
        step(world);  // the least step cannot be used for the first step
        ContactFeatures features = features_of(world);
        if (kernels().contains(how)) {
            for (bool ContactFeatures::*const feature : kernels().at(how)) features.*feature = true;
            throughput::make_room_for(world, features);
        }
        for (long k = 0; k < steps; ++k) throughput::least_step(world, features);
    }
    std::cout << world.bodies.size() << '\n';
    return 0;
}
