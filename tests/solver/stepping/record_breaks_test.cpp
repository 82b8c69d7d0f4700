// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the record of a break (solver/MODEL.md 5) with two discs pulled apart at given speeds. If x is the opening
// relative to the overlap at bonding and r the ratio of slip to opening, the normal force is -x of the strength. The
// shear force is r x k_s/k_n until the point slides.

#include "solver/stepping/record_breaks.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "tests/support/claim.hpp"

namespace crackle::record_breaks_test {
namespace {

using testing::agrees;

constexpr double radius = 0.02, overlap = 1e-7, stiffness = 1e7, shear_share = 0.25, time_step = 1e-5;
constexpr double strength = stiffness * overlap, energy = 0.5 * strength * overlap;
// The normal rotates by the slip divided by the distance of the centres, at most 20 overlaps over 4 cm.
constexpr double turn = 1e-4;

/// Two bonded discs side by side. One is held, and the other is driven away by `opening`, and along the face by `slip`,
/// in overlaps per step.
World pulled_pair(double friction_angle, double opening, double slip) {
    Scene scene;
    Material material;
    material.density = 1e12;
    material.normal_stiffness = stiffness;
    material.shear_stiffness = shear_share * stiffness;
    material.friction_angle = friction_angle;
    scene.materials = {material};
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.time_step = time_step;
    scene.add_circle_body(4, 0, {{0.0, 0.0}, radius, 0.0});
    scene.add_circle_body(9, 0, {{2.0 * radius - overlap, 0.0}, radius, 0.0});
    const DofControl still{Drive::velocity, 0.0};
    const double unit = overlap / time_step;
    scene.controls = {{0, still, still, {}, 0},  // free to turn, or nothing would be left to compute; far too heavy to
                      {1, {Drive::velocity, opening * unit}, {Drive::velocity, slip * unit}, still, 0}};
    World world = build_world(scene);
    EXPECT_EQ(bond_all(world, 0.0), 1);
    return world;
}

BreakEvent broken(World& world) {
    for (int n = 0; n < 100 && world.bonds.events.empty(); ++n) step(world);
    EXPECT_EQ(world.bonds.events.size(), 1U);
    const BreakEvent event = world.bonds.events.at(0);
    EXPECT_EQ((std::set{event.body_i, event.body_j}), (std::set{4, 9}));
    EXPECT_TRUE(agrees("strength, N", event.strength, strength, 1e-7));  // positions are accurate to 1e-16 of 4 cm
    EXPECT_TRUE(event.last_of_interface);
    EXPECT_EQ(world.bonds.broken, 1);
    EXPECT_EQ(world.bonds.interfaces_lost, 1);
    for (PointIndex k = 0; k < world.points.size(); ++k) EXPECT_EQ(world.points.shear_force[k], 0.0);
    return event;
}

TEST(BreakEvent, OfAPullTakesTheNormalSpringsEnergy) {
    World world = pulled_pair(27.0, 0.07, 0.0);  // opening 0.98 after 14 steps, 1.05 after 15
    const BreakEvent event = broken(world);
    EXPECT_EQ(event.step, 15);
    EXPECT_TRUE(agrees("normal force, N", event.normal_force, -0.98 * strength, 1e-6));
    EXPECT_TRUE(testing::within("shear force, N", event.shear_force, 0.0, turn * strength));
    EXPECT_TRUE(agrees("energy, J", event.energy, 0.98 * 1.05 * energy, 1e-6));
    EXPECT_FALSE(event.slid);
    EXPECT_FALSE(event.shear_mode);
    EXPECT_TRUE(agrees("place, m", event.position.x, radius, 1e-4));
    EXPECT_TRUE(testing::within("orientation, rad", event.orientation, 0.0, turn));
}

TEST(BreakEvent, WithoutSlidingTakesTheShearSpringsEnergyToo) {
    // At 89.9 degrees the limit is 573 times the normal force, so the point does not slide before the last step at 0.02
    // of the strength.
    World world = pulled_pair(89.9, 0.07, 0.42);
    const BreakEvent event = broken(world);
    const double ratio = 6.0 * shear_share;  // ratio of shear to normal force
    EXPECT_FALSE(event.slid);
    EXPECT_FALSE(event.shear_mode) << "a point that never slid parts in tension";
    EXPECT_TRUE(agrees("normal force, N", event.normal_force, -0.98 * strength, turn));
    EXPECT_TRUE(agrees("shear force, N", std::abs(event.shear_force), ratio * 0.98 * strength, turn));
    EXPECT_TRUE(
        agrees("energy, J", event.energy, (1.0 + ratio * ratio / shear_share) * 0.98 * 1.05 * energy, 2.0 * turn));
}

TEST(BreakEvent, TakesNothingOfAForceThatTurnsInItsLastStep) {
    World world = pulled_pair(89.9, 0.07, 0.42);
    for (int n = 0; n < 14; ++n) step(world);
    compute_forces(world);                                     // slip of 14 x 0.42 overlaps
    change_velocity(world, 1, 1, -7.0 * overlap / time_step);  // slip of -1.12 overlaps after the last step
    const BreakEvent event = broken(world);
    EXPECT_EQ(event.step, 15);
    EXPECT_TRUE(agrees("energy, J", event.energy, 0.98 * 1.05 * energy, 2.0 * turn)) << "the normal spring's";
}

TEST(BreakEvent, ThatSlidAndLastCarriedHalfItsStrengthByPullIsTension) {
    World world = pulled_pair(27.0, 0.07, 0.42);
    const BreakEvent event = broken(world);
    EXPECT_TRUE(event.slid);
    EXPECT_FALSE(event.shear_mode);
    EXPECT_TRUE(agrees("normal force, N", event.normal_force, -0.98 * strength, turn));
    EXPECT_TRUE(agrees("shear force, N", std::abs(event.shear_force),
                       0.02 * std::tan(27.0 * std::numbers::pi / 180.0) * strength,
                       0.01));  // 1e-4 of the limit at 0.02
}

TEST(BreakEvent, ThatSlidAndLastCarriedHalfItsStrengthByShearIsShear) {
    World world = pulled_pair(45.0, 0.3, 9.0);
    step(world);  // opening 0.3, sliding at 0.7
    change_velocity(world, 1, 0, 0.8 * overlap / time_step);
    const BreakEvent event = broken(world);
    EXPECT_EQ(event.step, 2);
    EXPECT_TRUE(event.slid);
    EXPECT_TRUE(event.shear_mode);
    EXPECT_TRUE(agrees("normal force, N", event.normal_force, -0.3 * strength, 10.0 * turn));
    EXPECT_TRUE(agrees("shear force, N", std::abs(event.shear_force), 0.7 * strength, 10.0 * turn));
}

TEST(BreakEvent, RemembersTheForcesOfTheLastStepAtHalfTheStrength) {
    World world = pulled_pair(89.9, 0.6, 0.5);
    step(world);  // opening 0.6, shear 0.125: beyond half the strength
    change_velocity(world, 1, 0, -0.3 * overlap / time_step);
    step(world);  // 0.3 and 0.25: below it
    change_velocity(world, 1, 0, 0.8 * overlap / time_step);
    const BreakEvent event = broken(world);
    EXPECT_EQ(event.step, 3);
    EXPECT_TRUE(agrees("normal force, N", event.normal_force, -0.6 * strength, turn));
    EXPECT_TRUE(agrees("shear force, N", std::abs(event.shear_force), 0.5 * shear_share * strength, turn));
}

}  // namespace
}  // namespace crackle::record_breaks_test
