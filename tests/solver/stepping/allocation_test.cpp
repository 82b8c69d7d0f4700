// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a step allocates no memory: malloc and similar functions, which operator new calls, are replaced by
// counting versions. Also tests the sizes of the records that a step accesses.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace {
std::atomic<std::int64_t> requests{0};
}

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): glibc's own names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT
void* __libc_realloc(void*, std::size_t);         // NOLINT
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT

void* malloc(std::size_t size) {
    ++requests;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    ++requests;
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    ++requests;
    return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    ++requests;
    return __libc_memalign(alignment, size);
}
}

namespace crackle {
namespace {

using verification::rock;

Material damped_rock() {
    Material material = rock();
    material.damping_ratio = 0.1;
    return material;
}

std::int64_t requests_in(World& world, int steps) {
    for (int n = 0; n < 10; ++n) step(world);  // threads are started here
    const std::int64_t built = world.list.builds, before = requests.load();
    for (int n = 0; n < steps; ++n) step(world);
    EXPECT_EQ(world.list.builds, built) << "the list was rebuilt, so this shows nothing";
    return requests.load() - before;
}

TEST(Allocation, IsSeenByTheCounter) {
    const std::int64_t before = requests.load();
    std::vector<int> numbers(1000);
    EXPECT_GT(requests.load(), before) << numbers.size();
    double* aligned = new (std::align_val_t{64}) double[8];
    EXPECT_GT(requests.load(), before + 1);
    operator delete[](aligned, std::align_val_t{64});
}

TEST(Step, AllocatesNothingInTenThousandStepsOfDiscs) {
    DisorderedDiscs request;
    request.columns = 12, request.rows = 12;
    Scene scene = disordered_discs(request, damped_rock());
    scene.domain = {-0.021, 10.0, -0.021, 10.0, {true, true, true, true}};
    scene.skin = 0.6;           // wide enough for the whole displacement
    scene.safety_factor = 0.5;  // small enough that new contacts require no new bound
    for (const int threads : {1, 2}) {
        World world = build_world(scene);
        bond_all(world, 0.0);
        verification::shake(world, 1.0 * verification::breaking_energy(world), 3);
        set_threads(world, threads);
        EXPECT_EQ(requests_in(world, 10000), 0) << threads << " threads";
        fmt::print("  discs, {} threads: no request in 10000 steps, {} bonds broken meanwhile\n", threads,
                   world.bonds.broken);
        EXPECT_GT(world.bonds.broken, 0);
    }
}

TEST(Step, AllocatesNothingUnderTheConsistentIntegrator) {
    DisorderedDiscs request;
    request.columns = 12, request.rows = 12;
    Scene scene = disordered_discs(request, damped_rock());
    scene.domain = {-0.021, 10.0, -0.021, 10.0, {true, true, true, true}};
    scene.skin = 0.6;
    scene.safety_factor = 0.5;  // as above
    scene.integrator = Integrator::consistent;
    World world = build_world(scene);
    bond_all(world, 0.0);
    verification::shake(world, 1.0 * verification::breaking_energy(world), 3);
    EXPECT_EQ(requests_in(world, 5000), 0);
    EXPECT_FALSE(world.points.opening.empty());
}

TEST(Step, AllocatesNothingInTenThousandStepsOfPolygonsAndDrivenBodies) {
    ShakenCells request;
    request.columns = 6, request.rows = 6;
    Scene scene = shaken_cells(request, damped_rock());
    scene.skin = 0.01;  // as above
    scene.controls.push_back({0, {Drive::velocity, 0.0}, {Drive::displacement, -1e-5}, {}, 5000});
    scene.controls.push_back({5, {Drive::force, 10.0}, {}, {Drive::force, 0.01}, 0});
    World world = build_world(scene);
    bond_all(world, 1.08e-3);
    verification::shake(world, 1e-4 * verification::breaking_energy(world), 3);
    EXPECT_EQ(requests_in(world, 10000), 0);
}

TEST(Records, HaveTheSizesTheyAreLaidOutFor) {
    EXPECT_EQ(sizeof(BodyState), 64u);
    EXPECT_EQ(alignof(BodyState), 64u);
    EXPECT_EQ(sizeof(BodyInertia), 32u);
    EXPECT_EQ(sizeof(BodyName), 12u);
    EXPECT_EQ(sizeof(BodyPair), 8u);
    EXPECT_EQ(sizeof(PointParts), 8u);
    EXPECT_EQ(sizeof(PointState), 4u);
    EXPECT_EQ(sizeof(PointForce), 32u);
    EXPECT_EQ(sizeof(BodyForce), 32u);
    EXPECT_EQ(sizeof(OpeningMemory), 16u);
}

}  // namespace
}  // namespace crackle
