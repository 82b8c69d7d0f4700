// SPDX-License-Identifier: GPL-3.0-or-later
// A disc with Coulomb friction on a plane: sliding that becomes rolling, slopes below and above the limit of rolling,
// oblique rebound.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace friction_scenes {
namespace {

constexpr double radius = 0.02, gravity = 9.81, kn = 1e7;

double friction_of(double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); }

/// A disc on the floor, with the overlap at which the spring carries its weight (m g, N).
Scene on_floor(double damping_ratio, double friction_angle, double normal_gravity) {
    Scene scene;
    scene.materials = {rock(friction_angle)};
    scene.materials[0].damping_ratio = damping_ratio;
    scene.domain = {-1000.0, 1000.0, 0.0, 1000.0, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, radius}, radius, 0.0});
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    scene.circles[0].centre.y = radius - mass * normal_gravity / kn;
    scene.gravity = {0.0, -normal_gravity};
    return scene;
}

std::vector<ClaimRow> disc_sliding_on_a_flat_ends_rolling() {
    Rows rows;
    // The speed is high, so that the spring's initial deformation, a distance of μmg/k_s, is only 2e-5 of the sliding
    // distance.
    const double speed = 1.0, mu = friction_of(20.0);
    Scene scene = on_floor(0.0, 20.0, gravity);  // a shear dashpot would add to friction until the first slip
    scene.bodies[0].velocity = {speed, 0.0};
    scene.time_step = 2e-6;
    World world = build_world(std::move(scene));
    const BodyState& disc = world.bodies.state[0];
    const double end = speed / (3.0 * mu * gravity);
    while (world.stepping.time < 0.5 * end) step(world);
    rows.relative("speed while sliding, m/s", disc.vx, speed - mu * gravity * world.stepping.time, 1e-3, "reference");
    rows.relative("spin while sliding, rad/s", -disc.omega, 2.0 * mu * gravity * world.stepping.time / radius, 1e-3,
                  "reference");
    // Sliding ends when the slip at the floor, v - |ω|R, is 0 for the first time.
    while (disc.vx + disc.omega * radius > 0.0) step(world);
    rows.relative("time at which it first rolls, s", world.stepping.time, end, 1e-3, "reference");
    while (world.stepping.time < 2.0 * end) step(world);
    // The undamped shear spring keeps oscillating about the rolling motion, so means over many periods are compared.
    double sum_v = 0.0, sum_w = 0.0;
    int samples = 0;
    for (; world.stepping.time < 12.0 * end; ++samples) {
        step(world);
        sum_v += disc.vx;
        sum_w += disc.omega;
    }
    rows.relative("rolling speed, m/s", sum_v / samples, 2.0 / 3.0 * speed, 1e-3, "reference");
    rows.relative("spin × radius when rolling, m/s", -sum_w / samples * radius, sum_v / samples, 1e-3, "reference");
    return rows.take();
}

struct Accelerations {
    double linear, angular;  // m/s2, rad/s2
};

/// Mean accelerations on a slope, measured after the springs have settled.
Accelerations down_slope(double slope, double friction_angle) {
    Scene scene = on_floor(0.4, friction_angle, gravity * std::cos(slope));
    scene.gravity.x = gravity * std::sin(slope);
    World world = build_world(std::move(scene));
    const BodyState& disc = world.bodies.state[0];
    while (world.stepping.time < 0.02) step(world);
    const double v = disc.vx, w = disc.omega, t = world.stepping.time;
    while (world.stepping.time < 0.22) step(world);
    return {(disc.vx - v) / (world.stepping.time - t), -(disc.omega - w) / (world.stepping.time - t)};
}

std::vector<ClaimRow> disc_on_a_slope() {
    Rows rows;
    const double angle = 10.0, mu = friction_of(angle);
    for (const double share : {0.3, 0.95}) {
        const double slope = std::atan(share * 3.0 * mu);
        const Accelerations a = down_slope(slope, angle);
        const std::string label = fmt::format("tan θ = {} of 3μ: ", share);
        rows.relative(label + "rolls, a, m/s2", a.linear, 2.0 / 3.0 * gravity * std::sin(slope), 1e-3, "reference");
        rows.relative(label + "turns with a/R, rad/s2", a.angular, 2.0 / 3.0 * gravity * std::sin(slope) / radius, 1e-3,
                      "reference");
    }
    for (const double share : {1.05, 2.0}) {
        const double slope = std::atan(share * 3.0 * mu);
        const Accelerations a = down_slope(slope, angle);
        const std::string label = fmt::format("tan θ = {} of 3μ: ", share);
        rows.relative(label + "slides, a, m/s2", a.linear, gravity * (std::sin(slope) - mu * std::cos(slope)), 1e-3,
                      "reference");
        rows.relative(label + "turns with 2μg cos θ/R, rad/s2", a.angular,
                      2.0 * mu * gravity * std::cos(slope) / radius, 1e-3, "reference");
    }
    return rows.take();
}

struct Rebound {
    double speed, spin;  // m/s; spin is multiplied by the radius
};

/// @param phase fraction of a step at which the contact begins, 0 to 1
Rebound oblique(double h, double friction_angle, Vec2 velocity, double steps_in_contact, double phase) {
    Scene scene = on_floor(h, friction_angle, 0.0);
    scene.bodies[0].velocity = velocity;
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    scene.time_step = std::numbers::pi / std::sqrt(kn / mass * (1.0 - h * h)) / steps_in_contact;
    scene.circles[0].centre.y = radius - (1.0 + phase) * velocity.y * scene.time_step;
    World world = build_world(std::move(scene));
    while (world.bodies.state[0].vy <= 0.0 || world.bodies.state[0].y < radius) step(world);
    return {world.bodies.state[0].vx, -world.bodies.state[0].omega * radius};
}

std::vector<ClaimRow> oblique_rebound_sliding_throughout() {
    Rows rows;
    const Vec2 velocity{5e-4, -1e-4};  // slow, since the arm is R - δ/2; δ/R is 3e-6
    for (const double h : {0.0, 0.215}) {
        const double mu = friction_of(10.0), e = std::exp(-std::numbers::pi * h / std::sqrt(1.0 - h * h));
        const Rebound expected{velocity.x + mu * (1.0 + e) * velocity.y, -2.0 * mu * (1.0 + e) * velocity.y};
        const auto worst = [&](double steps) {
            Rebound far = expected;
            for (const double phase : {0.125, 0.375, 0.625, 0.875}) {
                const Rebound got = oblique(h, 10.0, velocity, steps, phase);
                if (std::abs(got.speed - expected.speed) > std::abs(far.speed - expected.speed)) far.speed = got.speed;
                if (std::abs(got.spin - expected.spin) > std::abs(far.spin - expected.spin)) far.spin = got.spin;
            }
            return far;
        };
        const Rebound coarse = worst(500.0), fine = worst(4000.0);
        const std::string label = fmt::format("h {}, t_c/4000, worst of 4 phases: ", h);
        // Without a dashpot, leapfrog gives exactly the spring's impulse for any step, so there is no convergence to
        // check.
        rows.relative(label + "speed along the floor, m/s", fine.speed, expected.speed, 1e-3, "reference");
        if (h > 0.0) {
            rows.converging({std::abs(coarse.speed - expected.speed), std::abs(fine.speed - expected.speed), 8.0, 1.0});
        }
        rows.relative(label + "spin × radius, m/s", fine.spin, expected.spin, 1e-3, "reference");
        if (h > 0.0)
            rows.converging({std::abs(coarse.spin - expected.spin), std::abs(fine.spin - expected.spin), 8.0, 1.0});
    }
    return rows.take();
}

}  // namespace
}  // namespace friction_scenes

std::vector<Claim> friction_claims() {
    using namespace friction_scenes;
    constexpr const char* group = "One and two bodies";
    return {
        {.name = "disc_sliding_on_a_flat_ends_rolling",
         .group = group,
         .statement = "v = v₀ - μgt until t = v₀/(3μg), then rolls at ⅔v₀",
         .check = disc_sliding_on_a_flat_ends_rolling},
        {.name = "disc_on_a_slope",
         .group = group,
         .statement = "tan θ ≤ 3μ: rolls, a = ⅔g sin θ; else slides, a = g(sin θ - μ cos θ)",
         .check = disc_on_a_slope,
         .note = "The lever arm ends midway between the surfaces, at R - δ/2, which changes the acceleration by 5e-5 "
                 "here."},
        {.name = "oblique_rebound_sliding_throughout",
         .group = group,
         .statement = "tan θ > max(3μ(1+e), μk_n/k_s): v_t' = v_t - μ(1+e)v_n, rω' = 2μ(1+e)v_n",
         .check = oblique_rebound_sliding_throughout,
         .note = "Coulomb's limit contains only the spring force. Its impulse is m v_n(1+e), since c∫dδ = 0 over a "
                 "contact whose dashpot may pull. Here tan θ is 5; the limits are 0.8 to 1.1 and 0.7."},
    };
}

}  // namespace crackle::verification
