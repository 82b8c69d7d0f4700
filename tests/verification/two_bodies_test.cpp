// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the energy account, driven bodies and automatic steps for one or two bodies. Closed forms are in
// tests/bench/verify.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

Scene one_disc(double radius, double damping_ratio, double friction_angle) {
    Scene scene;
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1e7;
    material.shear_stiffness = 2.5e6;
    material.damping_ratio = damping_ratio;
    material.friction_angle = friction_angle;
    scene.materials = {material};
    scene.domain = {-1000.0, 1000.0, 0.0, 1000.0, {true, true, true, true}};
    scene.add_circle_body(1, 0, {{0.0, radius * (1.0 + 1e-6)}, radius, 0.0});
    return scene;
}

double contact_time(double mass, double stiffness, double h) {
    return std::numbers::pi / (std::sqrt(stiffness / mass) * std::sqrt(1.0 - h * h));
}

TEST(Ledger, ClosesToSecondOrderForABounceWithDashpotAndFriction) {
    const auto error = [](double steps_in_contact) {
        Scene scene = one_disc(0.02, 0.1, 30.0);
        scene.gravity = {0.0, -9.81};
        scene.circles[0].centre.y = 0.03;
        scene.bodies[0].velocity = {0.05, 0.0};
        const double mass = mass_properties(scene, scene.bodies[0]).mass;
        scene.time_step = contact_time(mass, 1e7, 0.1) / steps_in_contact;
        World world = build_world(scene);
        double worst = 0.0;
        while (world.stepping.time < 0.06) {
            compute_forces(world);
            worst = std::max(worst, std::abs(measure_ledger(world).closing_error));
            advance(world);
        }
        return worst / (mass * 9.81 * 0.01);
    };
    const double coarse = error(100.0), fine = error(800.0);
    const double order = std::log2(coarse / fine) / 3.0;
    fmt::print("  closing error over the energy of the fall: {:.3g} at t_c/100, {:.3g} at t_c/800, order {:.2f}\n",
               coarse, fine, order);
    EXPECT_LT(fine, 1e-3);
    EXPECT_GT(order, 0.8);  // contact begins and ends within a step, so the order is at least one
}

TEST(Controls, TheGuidesForceControlledSegmentMovesAsPrinted) {
    Scene scene;
    Material material;
    material.density = 2.5;
    material.normal_stiffness = 1e8;
    material.shear_stiffness = 0.25e8;
    scene.materials = {material};
    scene.domain = {-10.0, 10.0, 0.0, 10.0, {true, true, true, true}};
    scene.gravity = {0.0, -980.0};
    scene.bare_segment_width = 0.1;
    scene.first_kick = FirstKick::full;
    scene.time_step = 2e-5;
    const std::uint32_t body = scene.add_chain_body(2, 0, {{-3.0, 1.0}, {-3.0, 6.0}}, false);
    scene.controls.push_back(
        {static_cast<int>(body), {Drive::force, 1e4}, {Drive::displacement, 0.0}, {Drive::displacement, 0.0}, 20000});
    World world = build_world(scene);
    const double a = 1e4 / 1.25;
    for (const int n : {1, 10, 20}) {
        while (world.stepping.steps < n) step(world);
        EXPECT_TRUE(within(fmt::format("x after {} steps", n), world.bodies.state[0].x,
                           -3.0 + a * 4e-10 * n * (n + 1) / 2.0, 1e-14));
    }
    EXPECT_EQ(fmt::format("{:.6g}", world.bodies.state[0].x), "-2.99933");
}

/// A block of 1 kg, driven along x.
Scene driven_block(const DofControl& along, Vec2 place = {}) {
    Scene scene;
    Material material;
    material.density = 1.0;
    material.normal_stiffness = 1e4;
    material.shear_stiffness = 1e4;
    scene.materials = {material};
    scene.domain.x1 = scene.domain.y1 = -10.0;
    scene.domain.x2 = scene.domain.y2 = 10.0;
    scene.domain.wall_present = {false, false, false, false};
    scene.time_step = 1e-3;
    const DofControl held{Drive::velocity, 0.0};
    const auto body = scene.add_chain_body(
        1, 0, {place + Vec2{1.0, 0.0}, place + Vec2{1.0, 1.0}, place + Vec2{0.0, 1.0}, place}, true);
    scene.controls.push_back({static_cast<int>(body), along, held, held, 0});
    return scene;
}

TEST(Controls, AForceWithASpringSwingsAboutWhereTheyBalanceAndClosesTheEnergy) {
    constexpr double force = 3.0, stiffness = 40.0;
    World world = build_world(driven_block({Drive::force, force, stiffness}));
    const double start = world.bodies.state[0].x, period = 2.0 * std::numbers::pi / std::sqrt(stiffness);
    double farthest = 0.0, worst = 0.0;
    while (world.stepping.time < 3.0 * period) {
        compute_forces(world);
        worst = std::max(worst, std::abs(measure_ledger(world).closing_error));
        farthest = std::max(farthest, world.bodies.state[0].x - start);
        advance(world);
    }
    const double wave = period / world.stepping.time_step;  // steps per period
    EXPECT_TRUE(agrees("farthest way, m", farthest, 2.0 * force / stiffness, 20.0 / (wave * wave)));
    // After whole periods it is back at the start; leapfrog's period is shorter by a factor of (ω Δt)²/24.
    compute_forces(world);
    EXPECT_TRUE(within("way after three periods, m", world.bodies.state[0].x - start, 0.0, 1e-3 * farthest));
    EXPECT_TRUE(
        within("closing error over the energy", worst / (force * force / stiffness), 0.0, 40.0 / (wave * wave)));
}

TEST(Controls, ASpringOfADriveCountsFromWhereItIsRelaxed) {
    World world = build_world(driven_block({Drive::force, 0.0, 40.0}));
    world.bodies.state[0].x += 0.5;
    bodies_moved(world);
    relax_drives(world);
    for (int n = 0; n < 10; ++n) step(world);
    EXPECT_TRUE(within("way of a block at rest, m", world.bodies.state[0].vx, 0.0, 0.0));
}

TEST(Controls, DrivenBodiesPassThroughEachOtherWhereTheyAreToldTo) {
    for (const bool touch : {true, false}) {
        Scene scene = driven_block({Drive::force, 0.0});
        const Scene other = driven_block({Drive::velocity, -1.0}, {1.5, 0.3});
        scene.add_chain_body(2, 0, other.vertices, true);
        scene.controls.push_back(other.controls.front());
        scene.controls.back().body = 1;
        scene.driven_contacts = touch ? DrivenContacts::unless_held : DrivenContacts::none;
        World world = build_world(scene);
        while (world.stepping.time < 1.0) step(world);
        compute_forces(world);
        const double speed = world.bodies.state[0].vx;
        EXPECT_EQ(speed == 0.0, !touch) << "the undriven block moves with " << speed << " m/s";
    }
}

/// Largest closing error relative to the energy of the fall: the guide's circle falls from 1.5 radii onto a floor
/// without losses and bounces 20 times. @param share step relative to the stable bound; 0 for an automatic step
double bouncing_error(double share) {
    Scene scene;
    Material material;
    material.density = 2.5;
    material.normal_stiffness = 1e8;
    material.shear_stiffness = 0.25e8;
    scene.materials = {material};
    scene.domain = {-10.0, 10.0, 0.0, 10.0, {true, true, true, true}};
    scene.gravity = {0.0, -980.0};
    scene.add_circle_body(1, 0, {{0.0, 5.0}, 2.0, 0.0});
    if (share > 0.0) scene.time_step = share * build_world(scene).stepping.step_bound;
    World world = build_world(scene);
    const double fall = world.bodies.inertia[0].mass * 980.0 * 3.0, once = 2.0 * std::sqrt(2.0 * 3.0 / 980.0);
    double worst = 0.0;
    while (world.stepping.time < 20.0 * once) {
        compute_forces(world);
        worst = std::max(worst, std::abs(measure_ledger(world).closing_error));
        advance(world);
    }
    return worst / fall;
}

// Largest allowed error after twenty bounces, for which loose_step_share is chosen.
constexpr double loose_step_error = 0.02;

TEST(TimeStep, DerivedWithoutBondsKeepsTheEnergyOfABouncingCircle) {
    for (const double share : {0.2, 0.1, 0.05}) {
        fmt::print("  share {}: largest closing error over the energy of the fall {:.3g}\n", share,
                   bouncing_error(share));
    }
    EXPECT_TRUE(within("error at the derived step", bouncing_error(0.0), 0.0, loose_step_error));
}

TEST(Ledger, ClosesWhenAHeldVelocityChanges) {
    const DofControl still{Drive::velocity, 0.0};
    for (const bool ramp : {true, false}) {
        Scene scene = one_disc(0.02, 0.0, 0.0);
        scene.circles[0].centre.y = 1.0;
        const DofControl x = ramp ? DofControl{Drive::displacement, 0.01} : DofControl{Drive::velocity, 0.5};
        const DofControl turn = ramp ? DofControl{Drive::displacement, 0.3} : DofControl{Drive::velocity, 20.0};
        scene.controls.push_back({0, x, still, turn, 100});
        scene.time_step = 1e-4;
        World world = build_world(scene);
        compute_forces(world);
        const double moving = measure_ledger(world).kinetic;
        double worst = 0.0;
        for (int n = 0; n < 300; ++n) {
            step(world);
            if (n == 99 && !ramp) {
                const DofControl faster[3] = {{Drive::velocity, 0.7}, still, still};
                set_control(world, 0, faster, 0);
            }
            if (n == 199) {
                const DofControl again[3] = {{Drive::displacement, -0.02}, still, {Drive::displacement, 0.1}};
                set_control(world, 0, again, 50);
            }
            compute_forces(world);
            worst = std::max(worst, std::abs(measure_ledger(world).closing_error));
        }
        ASSERT_GT(moving, 0.0);
        EXPECT_EQ(measure_ledger(world).kinetic, 0.0);
        EXPECT_TRUE(within("closing error over the kinetic energy", worst / moving, 0.0, 1e-12));
    }
}

}  // namespace
}  // namespace crackle
