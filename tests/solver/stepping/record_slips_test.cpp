// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the record of first slips of bonds, with two discs of which one is driven along the other.

#include "solver/stepping/record_slips.hpp"

#include <cmath>
#include <numbers>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"

namespace crackle::record_slips_test {
namespace {

using testing::agrees;

constexpr double radius = 0.02, overlap = 1e-7, stiffness = 1e7, time_step = 1e-5;

/// Two bonded discs; the right one is driven along the other by 0.01 of the overlap per step, and away by `opening`.
World rubbing_pair(bool watched, double opening) {
    Scene scene;
    scene.materials = {undamped_rock(stiffness, 27.0)};
    scene.materials[0].density = 1e12;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.time_step = time_step;
    scene.add_circle_body(4, 0, {{0.0, 0.0}, radius, 0.0});
    scene.add_circle_body(9, 0, {{2.0 * radius - overlap, 0.0}, radius, 0.0});
    const DofControl still{Drive::velocity, 0.0};
    const double unit = overlap / time_step;
    scene.controls = {{0, still, still, {}, 0},
                      {1, {Drive::velocity, opening * unit}, {Drive::velocity, 0.01 * unit}, still, 0}};
    World world = build_world(scene);
    bond_all(world, 0.0);
    world.bonds.watch_slips = watched;
    return world;
}

TEST(RecordSlips, HoldsTheFirstArrivalAtTheLimitOfABondOnce) {
    // With k_s = k_n/4, the shear force grows by 0.0025 k_n δ0 per step and reaches the limit, tan 27° times k_n δ0,
    // after 204 steps.
    World world = rubbing_pair(true, 0.0);
    for (int n = 0; n < 400; ++n) step(world);
    ASSERT_EQ(world.bonds.slips.size(), 1U);
    const SlipEvent& slip = world.bonds.slips[0];
    const double friction = std::tan(27.0 * std::numbers::pi / 180.0);
    EXPECT_EQ(slip.step, static_cast<std::int64_t>(std::ceil(friction / 0.0025)));
    EXPECT_EQ(std::min(slip.body_i, slip.body_j), 4);
    EXPECT_EQ(std::max(slip.body_i, slip.body_j), 9);
    // The slip of two overlaps increases the distance of the centres by 5e-6 of an overlap.
    EXPECT_TRUE(agrees("shear force, N", std::abs(slip.shear_force), friction * stiffness * overlap, 1e-5));
    EXPECT_TRUE(testing::within("normal force, N", slip.normal_force, 0.0, 1e-5 * stiffness * overlap));
    EXPECT_TRUE(agrees("place, m", slip.position.x, radius, 1e-4));
}

TEST(RecordSlips, KnowsTheNormalForceOfABondThatOpens) {
    World world = rubbing_pair(true, 1e-3);
    for (int n = 0; n < 400 && world.bonds.slips.empty(); ++n) step(world);
    ASSERT_EQ(world.bonds.slips.size(), 1U);
    const SlipEvent& slip = world.bonds.slips[0];
    const double opened = -1e-3 * static_cast<double>(slip.step) * stiffness * overlap;
    EXPECT_TRUE(agrees("normal force, N", slip.normal_force, opened, 1e-4));
}

TEST(RecordSlips, ChangesNoResult) {
    World watched = rubbing_pair(true, 1e-3), alone = rubbing_pair(false, 1e-3);
    for (int n = 0; n < 400; ++n) {
        step(watched);
        step(alone);
    }
    EXPECT_TRUE(alone.bonds.slips.empty());
    EXPECT_EQ(watched.bodies.state[1].x, alone.bodies.state[1].x);
    EXPECT_EQ(watched.points.shear_force[0], alone.points.shear_force[0]);
    EXPECT_EQ(watched.account.friction_loss, alone.account.friction_loss);
}

}  // namespace
}  // namespace crackle::record_slips_test
