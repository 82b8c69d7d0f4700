// SPDX-License-Identifier: GPL-3.0-or-later
// Tests how the properties of two materials combine at a contact, and how two unequal masses rebound. Without Coulomb
// resistance or a shear spring, the force of the shear dashpot must be limited.

#include <cmath>
#include <numbers>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/support/claim.hpp"

namespace crackle::law_test {
namespace {

constexpr double gravity = 9.81, speed = 0.1;

/// A disc of radius 2 cm thrown along the floor on which it lies; another material in the scene has friction.
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
    EXPECT_TRUE(testing::agrees("speed", world.bodies.state[0].vx, speed, 1e-12));
    EXPECT_EQ(world.bodies.state[0].omega, 0.0);
}

TEST(ShearDashpot, WithoutAShearSpringIsCappedByCoulombsLimit) {
    const double mu = std::tan(20.0 * std::numbers::pi / 180.0);
    World world = thrown_disc(20.0, 1e3);
    while (world.stepping.time < 0.5 * speed / (3.0 * mu * gravity)) step(world);
    EXPECT_TRUE(testing::agrees("speed while sliding", world.bodies.state[0].vx,
                                speed - mu * gravity * world.stepping.time, 1e-3));
    while (world.stepping.time < 3.0 * speed / (3.0 * mu * gravity)) step(world);
    EXPECT_TRUE(
        testing::agrees("rolls in the end at 2/3 of its speed", world.bodies.state[0].vx, 2.0 / 3.0 * speed, 1e-3));
    compute_forces(world);
    const Ledger ledger = measure_ledger(world);
    EXPECT_TRUE(testing::within("closing error over the loss", ledger.closing_error / ledger.dashpot_loss, 0.0, 1e-3));
}

Material material_of(double normal_stiffness, double shear_stiffness, double friction_angle) {
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = normal_stiffness;
    material.shear_stiffness = shear_stiffness;
    material.friction_angle = friction_angle;
    return material;
}

/// Discs of radii 1 and 3 cm and of different materials that overlap by `overlap` and approach with `speed_each`.
World two_discs(const Material& a, const Material& b, double overlap, double speed_each, double time_step) {
    Scene scene;
    scene.materials = {a, b};
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.01, 0.0});
    scene.add_circle_body(2, 1, {{0.04 - overlap, 0.0}, 0.03, 0.0});
    scene.bodies[0].velocity = {speed_each, 0.0};
    scene.bodies[1].velocity = {-speed_each, 0.0};
    scene.time_step = time_step;
    return build_world(scene);
}

TEST(TwoMaterials, SpringsStandInSeriesAndTheLowerFrictionCounts) {
    World world = two_discs(material_of(1e7, 2e6, 40.0), material_of(3e7, 8e6, 25.0), 1e-5, 0.0, 1e-7);
    compute_forces(world);
    ASSERT_EQ(world.points.size(), 1U);
    const PointView view = view_point(world, 0);
    EXPECT_TRUE(testing::agrees("normal stiffness 2 k1 k2/(k1 + k2), N/m", view.normal_stiffness, 1.5e7, 1e-14));
    EXPECT_TRUE(testing::agrees("shear stiffness, N/m", view.shear_stiffness, 3.2e6, 1e-14));
    EXPECT_TRUE(testing::agrees("friction", view.friction, std::tan(25.0 * std::numbers::pi / 180.0), 1e-14));
    EXPECT_TRUE(testing::agrees("normal force, N", view.normal_force, 150.0, 1e-9));
}

TEST(TwoMaterials, UnequalDiscsReboundByTheirEffectiveMassAndDashpotsInSeries) {
    // Closed form of one spring and dashpot, with contact until the overlap is 0: e = exp(-πh/sqrt(1 - h²)),
    // h = c/(2 sqrt(k m)), m = m1 m2/(m1 + m2). The error of the lagged dashpot is of first order in the step.
    Material a = material_of(1e7, 2e6, 0.0), b = material_of(3e7, 8e6, 0.0);
    const double m1 = 2500.0 * std::numbers::pi * 1e-4, m2 = 9.0 * m1, mass = m1 * m2 / (m1 + m2), k = 1.5e7;
    const double half_dashpot = 0.2 * std::sqrt(k * mass);  // c/2 for h = 0.2
    a.normal_damping = 2.0 * half_dashpot * 2.0 / 3.0;      // in series with twice that: 2·c1·c2/(c1 + c2)
    b.normal_damping = 2.0 * a.normal_damping;
    const double c = 2.0 * a.normal_damping * b.normal_damping / (a.normal_damping + b.normal_damping);
    const double h = c / (2.0 * std::sqrt(k * mass)),
                 expected = std::exp(-std::numbers::pi * h / std::sqrt(1.0 - h * h));
    double error[2] = {};
    for (const int halving : {0, 1}) {
        World world = two_discs(a, b, -1e-6, 0.5, 1e-6 / (1 << halving));
        while (world.bodies.state[0].vx > world.bodies.state[1].vx ||
               world.bodies.state[1].x - world.bodies.state[0].x < 0.0401)
            step(world);
        const double restitution = world.bodies.state[1].vx - world.bodies.state[0].vx;  // before: 1 m/s
        error[halving] = restitution - expected;
        EXPECT_TRUE(testing::agrees("restitution", restitution, expected, 5e-3));
        const double momentum = m1 * world.bodies.state[0].vx + m2 * world.bodies.state[1].vx;
        EXPECT_TRUE(testing::agrees("momentum, Ns", momentum, 0.5 * (m1 - m2), 1e-12));
    }
    EXPECT_TRUE(testing::agrees("error at half the step over error", error[1] / error[0], 0.5, 0.25));
}

TEST(TwoMaterials, DampedInDifferentWaysAreRefused) {
    Material by_ratio = material_of(1e7, 2e6, 0.0), by_dashpot = by_ratio;
    by_ratio.damping_ratio = 0.2;
    by_dashpot.normal_damping = 100.0;
    try {
        two_discs(by_ratio, by_dashpot, 1e-5, 0.0, 1e-7);
        ADD_FAILURE() << "expected an error: the discs would not be damped";
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_NE(
            std::string(error.what()).find("found a damping ratio in one material and dashpot coefficients in another"),
            std::string::npos);
    }
}

}  // namespace
}  // namespace crackle::law_test
