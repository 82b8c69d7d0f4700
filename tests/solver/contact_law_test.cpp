// SPDX-License-Identifier: GPL-3.0-or-later
// Where there is no Coulomb resistance or no shear spring, the shear dashpot cannot drag without limit.

#include <cmath>
#include <numbers>

#include "solver/world.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

constexpr double gravity = 9.81, speed = 0.1;

/// A disc of radius 2 cm thrown along the floor on which it rests; another material in the scene has friction.
World thrown_disc(double friction_angle, double shear_damping) {
    Scene scene;
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1e7;
    material.shear_stiffness = 0.0;
    material.shear_damping = shear_damping;
    material.friction_angle = friction_angle;
    Material rough = material;
    rough.friction_angle = 30.0;
    scene.materials = {material, rough};
    scene.domain = {-1000.0, 1000.0, 0.0, 1000.0, {true, true, true, true}};
    scene.gravity = {0.0, -gravity};
    scene.add_circle_body(1, 0, {{0.0, 0.02}, 0.02, 0.0});
    scene.circles[0].centre.y -= mass_properties(scene, scene.bodies[0]).mass * gravity / 1e7;
    scene.bodies[0].velocity = {speed, 0.0};
    scene.time_step = 1e-5;
    return build_world(scene);
}

TEST(ShearDashpot, DoesNotDragAFrictionlessContact) {
    World world = thrown_disc(0.0, 1e3);
    for (int n = 0; n < 1000; ++n) step(world);
    EXPECT_TRUE(testing::agrees("speed", world.bodies[0].vx, speed, 1e-12));
    EXPECT_EQ(world.bodies[0].omega, 0.0);
}

TEST(ShearDashpot, WithoutAShearSpringIsCappedByCoulombsLimit) {
    const double mu = std::tan(20.0 * std::numbers::pi / 180.0);
    World world = thrown_disc(20.0, 1e3);
    while (world.time < 0.5 * speed / (3.0 * mu * gravity)) step(world);
    EXPECT_TRUE(testing::agrees("speed while sliding", world.bodies[0].vx, speed - mu * gravity * world.time, 1e-3));
    while (world.time < 3.0 * speed / (3.0 * mu * gravity)) step(world);
    EXPECT_TRUE(testing::agrees("rolls in the end at 2/3 of its speed", world.bodies[0].vx, 2.0 / 3.0 * speed, 1e-3));
    compute_forces(world);
    const Ledger ledger = measure_ledger(world);
    EXPECT_TRUE(testing::within("closing error over the loss", ledger.closing_error / ledger.dashpot_loss, 0.0, 1e-3));
}

}  // namespace
}  // namespace crackle
