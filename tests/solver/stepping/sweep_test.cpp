// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that step(), which moves bodies while forces are still being computed, gives the same results as
// compute_forces() followed by advance().

#include "solver/stepping/sweep.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/same_bytes.hpp"

namespace crackle {
namespace {

using testing::same_bytes;

struct SweptScene {
    const char* name;
    Scene scene;
    double thick;
    double share;  // kinetic energy relative to the energy that breaks every bond
    bool breaks;
};

Material lightly_damped_rock() {
    Material material = verification::rock();
    material.damping_ratio = 0.05;
    return material;
}

/// Discs in a box, enough for several threads to have their own blocks; one is driven and one is pushed.
Scene driven_discs(Integrator integrator) {
    DisorderedDiscs request;
    request.columns = 24, request.rows = 24;
    Scene scene = disordered_discs(request, lightly_damped_rock());
    scene.domain = {-0.021, 10.0, -0.021, 10.0, {true, true, true, true}};
    scene.integrator = integrator;
    scene.controls.push_back({40, {Drive::velocity, 0.0}, {Drive::displacement, 1e-4}, {}, 300});
    scene.controls.push_back({300, {Drive::force, 10.0}, {}, {Drive::force, 0.01}, 0});
    return scene;
}

Scene driven_cells() {
    ShakenCells request;
    request.columns = 12, request.rows = 12;
    Scene scene = shaken_cells(request, lightly_damped_rock());
    scene.controls.push_back({0, {Drive::velocity, 0.0}, {Drive::displacement, -1e-5}, {}, 300});
    return scene;
}

World bonded_and_shaken(const SweptScene& swept_scene, int threads) {
    World world = build_world(swept_scene.scene);
    bond_all(world, swept_scene.thick);
    verification::shake(world, swept_scene.share * verification::breaking_energy(world), 3);
    set_threads(world, threads);
    return world;
}

TEST(Sweep, HasTheBytesOfForcesThenMotionOnAnyNumberOfThreads) {
    const SweptScene scenes[] = {
        {"discs that break", driven_discs(Integrator::leapfrog), 0.0, 1.0, true},
        {"discs under the consistent integrator", driven_discs(Integrator::consistent), 0.0, 1.0, true},
        {"cells that break", driven_cells(), 1.08e-3, 1.0, true},
        {"cells that hold", driven_cells(), 1.08e-3, 1e-6, false},
    };
    for (const SweptScene& swept_scene : scenes) {
        World apart = bonded_and_shaken(swept_scene, 1);
        for (int n = 0; n < 600; ++n) {
            compute_forces(apart);
            advance(apart);
        }
        compute_forces(apart);
        EXPECT_EQ(apart.bonds.broken > 0, swept_scene.breaks) << swept_scene.name;
        EXPECT_GT(apart.list.builds, 1) << swept_scene.name;
        for (const int threads : {1, 2, 3, 7}) {
            World swept = bonded_and_shaken(swept_scene, threads);
            for (int n = 0; n < 600; ++n) step(swept);
            compute_forces(swept);
            SCOPED_TRACE(std::string(swept_scene.name) + ", " + std::to_string(threads) + " threads");
            testing::expect_same_run(swept, apart);
            ASSERT_EQ(swept.bonds.events.size(), apart.bonds.events.size());
            for (std::size_t e = 0; e < swept.bonds.events.size(); ++e) {
                EXPECT_EQ(swept.bonds.events[e].step, apart.bonds.events[e].step);
                EXPECT_EQ(swept.bonds.events[e].position.x, apart.bonds.events[e].position.x);
                EXPECT_EQ(swept.bonds.events[e].energy, apart.bonds.events[e].energy);
            }
        }
    }
}

// OMP_THREAD_LIMIT and OMP_DYNAMIC are simulated: inside another parallel region, a team has only one thread.
TEST(Sweep, HasTheSameBytesWhereFewerThreadsAreGivenThanAskedFor) {
    const SweptScene scenes[] = {{"discs", driven_discs(Integrator::leapfrog), 0.0, 1.0, true},
                                 {"cells", driven_cells(), 1.08e-3, 1.0, true}};
    for (const SweptScene& swept_scene : scenes) {
        World alone = bonded_and_shaken(swept_scene, 1), given_one = bonded_and_shaken(swept_scene, 3);
        for (int n = 0; n < 300; ++n) step(alone);
        int team = 0;
#pragma omp parallel num_threads(2)
#pragma omp single
        {
            for (int n = 0; n < 300; ++n) step(given_one);
#pragma omp parallel num_threads(3)
#pragma omp single
            team = omp_get_num_threads();
        }
        ASSERT_EQ(team, 1);
        compute_forces(alone);
        compute_forces(given_one);
        EXPECT_GT(alone.bonds.broken, 0);
        testing::expect_same_run(given_one, alone);
    }
}

TEST(Sweep, FindsTheSameForcesWhetherThoseOfPointsAreKept) {
    World kept = bonded_and_shaken({"", driven_discs(Integrator::leapfrog), 0.0, 1.0, true}, 2);
    World forgotten = kept;
    forget_point_forces(forgotten);
    for (int n = 0; n < 300; ++n) {
        step(kept);
        step(forgotten);
    }
    EXPECT_FALSE(kept.points.force.empty());
    EXPECT_TRUE(forgotten.points.force.empty());
    EXPECT_TRUE(same_bytes(kept.bodies.state, forgotten.bodies.state));
    EXPECT_THROW(measure_wall_forces(forgotten), std::logic_error);
}

}  // namespace
}  // namespace crackle
