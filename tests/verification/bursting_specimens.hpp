// SPDX-License-Identifier: GPL-3.0-or-later
// Bonded specimens that fly apart, so that bonds break and neighbour lists are rebuilt often, and hashes of their
// states during a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace crackle::testing {

/// Gives bodies velocities away from the centre, at strain rates of a few per second, plus random velocities.
inline void burst(World& world, double rate, double noise, std::uint64_t seed) {
    verification::shake(world, noise * verification::breaking_energy(world), seed);
    Vec2 middle;
    for (const BodyState& body : world.bodies.state) middle = middle + Vec2{body.x, body.y};
    middle = (1.0 / static_cast<double>(world.bodies.size())) * middle;
    for (BodyState& body : world.bodies.state) {
        body.vx += rate * (body.x - middle.x);
        body.vy += 0.3 * rate * (body.y - middle.y);
    }
}

inline World bursting_discs(int columns, int rows, double rate, double noise,
                            Integrator integrator = Integrator::leapfrog) {
    DisorderedDiscs request;
    request.columns = columns, request.rows = rows, request.shake = 5e-5;
    Material material = verification::rock();
    material.damping_ratio = 0.05;
    Scene scene = disordered_discs(request, material);
    scene.domain = {-0.1, 0.04 * columns + 0.1, -0.05, 0.0, {true, true, true, false}};
    scene.gravity = {0.0, -9.81};
    scene.integrator = integrator;
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    burst(world, rate, noise, 3);
    return world;
}

inline World bursting_cells(int columns, int rows, double rate, double noise, SegmentLaw law = SegmentLaw::rounded,
                            Integrator integrator = Integrator::leapfrog) {
    ShakenCells request;
    request.columns = columns, request.rows = rows;
    Material material = verification::rock();
    material.damping_ratio = 0.05;
    Scene scene = shaken_cells(request, material);
    scene.segment_law = law;
    scene.integrator = integrator;
    World world = build_world(std::move(scene));
    bond_all(world, 1.08e-3);
    burst(world, rate, noise, 4);
    return world;
}

struct Trace {
    std::vector<std::uint64_t> hashes;  // hashes of the state every 100 steps
    std::string last;                   // all bytes of the final state
    std::int64_t broken = 0, rebuilds = 0;
    std::vector<std::int64_t> thread_blocks;
};

inline Trace trace_of(World world, int threads, int steps) {
    set_threads(world, threads);
    Trace trace;
    const std::int64_t built = world.list.builds;
    for (int n = 1; n <= steps; ++n) {
        step(world);
        if (n % 100 == 0) trace.hashes.push_back(verification::hash_of(save_world(world)));
    }
    trace.last = save_world(world);
    trace.broken = world.bonds.broken;
    trace.rebuilds = world.list.builds - built;
    trace.thread_blocks = world.workers.blocks_done;
    return trace;
}

inline void check_threads(const World& start, int steps, std::int64_t least_rebuilds, std::int64_t least_breaks) {
    const Trace one = trace_of(start, 1, steps);
    fmt::print("  {} bodies, {} steps, {} rebuilds, {} breaks, final hash {:016x}\n", start.bodies.size(), steps,
               one.rebuilds, one.broken, one.hashes.back());
    EXPECT_GE(one.rebuilds, least_rebuilds);
    EXPECT_GE(one.broken, least_breaks);
    for (const int threads : {2, 3, 7}) {
        const Trace many = trace_of(start, threads, steps);
        for (std::size_t k = 0; k < one.hashes.size(); ++k) {
            ASSERT_EQ(many.hashes[k], one.hashes[k]) << threads << " threads, first seen at step " << 100 * (k + 1);
        }
        EXPECT_TRUE(many.last == one.last);
        ASSERT_EQ(many.thread_blocks.size(), static_cast<std::size_t>(threads));
        std::int64_t sum = 0;
        for (std::size_t t = 0; t < many.thread_blocks.size(); ++t) {
            EXPECT_GT(many.thread_blocks[t], 0) << "thread " << t << " of " << threads;
            sum += many.thread_blocks[t];
        }
        EXPECT_EQ(sum, one.thread_blocks[0]);
    }
}

/// Stops at five random steps, saves, loads, and continues with other numbers of threads.
inline void check_restarts(const World& start, int steps, std::uint64_t seed) {
    const Trace straight = trace_of(start, 1, steps);
    EXPECT_GT(straight.broken, 0);
    std::mt19937_64 generator(seed);
    for (int k = 0; k < 5; ++k) {
        const int stop = 1 + static_cast<int>(uniform_below(generator, static_cast<std::uint64_t>(steps - 1)));
        const bool forces_known = k % 2 == 1;  // stopped either after the force pass or after the step
        World world = start;
        for (int n = 0; n < stop; ++n) step(world);
        if (forces_known) compute_forces(world);
        const std::int64_t events = static_cast<std::int64_t>(world.bonds.events.size());
        World again = load_world(save_world(world), "memory");
        EXPECT_TRUE(save_world(again) == save_world(world)) << "stopped at step " << stop;
        EXPECT_EQ(static_cast<std::int64_t>(again.bonds.events.size()), events);
        set_threads(again, 1 + k % 3);
        for (int n = stop; n < steps; ++n) step(again);
        const std::string bytes = save_world(again);
        fmt::print("  stopped at step {} {}: {}\n", stop, forces_known ? "with forces" : "after the step",
                   bytes == straight.last ? "same bytes" : "OTHER BYTES");
        EXPECT_TRUE(bytes == straight.last);
        // The events of both parts together must be those of the uninterrupted run.
        EXPECT_EQ(static_cast<std::int64_t>(again.bonds.events.size()), straight.broken);
    }
}

}  // namespace crackle::testing
