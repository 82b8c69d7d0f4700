// SPDX-License-Identifier: GPL-3.0-or-later
// Particle-steps per second of bonded discs and hexagons with friction, dashpots and energy account; also contacts per
// particle. Arguments: particles along one side, threads.

#include <benchmark/benchmark.h>

#include <random>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"

namespace crackle {
namespace {

Material rock() {
    Material material = undamped_rock(1e7, 27.0);
    material.damping_ratio = 0.2;
    return material;
}

void run(benchmark::State& state, Scene scene, double thick) {
    std::mt19937_64 random(1);
    for (Body& body : scene.bodies)
        body.velocity = {1e-9 * static_cast<double>(random() % 1000), 1e-9 * static_cast<double>(random() % 1000)};
    scene.threads = static_cast<int>(state.range(1));
    World world = build_world(scene);
    const std::int64_t bonds = bond_all(world, thick);
    for (auto _ : state) step(world);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(world.bodies.size()));
    state.counters["contacts_per_particle"] = static_cast<double>(bonds) / static_cast<double>(world.bodies.size());
    state.counters["rebuilds"] = static_cast<double>(world.list.builds);
}

void bonded_discs(benchmark::State& state) {
    const int side = static_cast<int>(state.range(0));
    run(state, triangular_lattice(side, side, 0.02, 8e-5, rock()), 0.0);
}

void bonded_hexagons(benchmark::State& state) {
    const int side = static_cast<int>(state.range(0));
    run(state, honeycomb(side, side, 0.02, 1e-3, rock()), 1.08e-3);
}

BENCHMARK(bonded_discs)->Args({18, 1})->Args({71, 1})->Args({224, 1})->Args({71, 2})->UseRealTime();
BENCHMARK(bonded_hexagons)->Args({18, 1})->Args({71, 1})->Args({71, 2})->UseRealTime();

}  // namespace
}  // namespace crackle

BENCHMARK_MAIN();
