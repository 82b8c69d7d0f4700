// SPDX-License-Identifier: GPL-3.0-or-later
// A rectangular block on a slope stays while tan θ < μ, else slides with a = g(sin θ - μ cos θ), and topples where its
// weight passes beyond its lower corner. The slope lies along x and gravity is turned; the ground is a domain wall, a
// fixed segment or a fixed polygon.

#include <cmath>
#include <numbers>

#include "tests/support/claim.hpp"
#include "tests/support/measures.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

constexpr double gravity = 9.81;
enum class Ground { wall, segment, polygon };

const char* name_of(Ground ground) {
    return ground == Ground::wall ? "wall" : ground == Ground::segment ? "segment" : "polygon";
}

/// Block of width and height (m) at rest on its springs; body id 1.
World block_on(Ground ground, double width, double height, double slope, double friction_angle) {
    Scene scene;
    Material material = testing::rock(friction_angle, 0.5);
    material.normal_stiffness = 1e8;
    material.shear_stiffness = 0.5e8;
    material.damping_ratio = 0.3;
    scene.materials = {material};
    scene.gravity = {gravity * std::sin(slope), -gravity * std::cos(slope)};
    scene.domain = {-100.0, 100.0, 0.0, 100.0, {false, false, ground == Ground::wall, false}};
    scene.thick = 1e-3;
    const double load = 0.5 * material.density * width * height * gravity;
    const double bottom = (ground == Ground::wall ? 0.0 : scene.thick) - load * std::cos(slope) / 1e8;
    scene.add_chain_body(1, 0, {{0.0, bottom}, {width, bottom}, {width, bottom + height}, {0.0, bottom + height}},
                         true);
    if (ground != Ground::wall) {
        std::vector<Vec2> outline{{-5.0, 0.0}, {5.0, 0.0}};
        if (ground == Ground::polygon) outline = {{-5.0, -1.0}, {5.0, -1.0}, {5.0, 0.0}, {-5.0, 0.0}};
        const auto body = scene.add_chain_body(2, 0, outline, ground == Ground::polygon);
        const DofControl held{Drive::velocity, 0.0};
        scene.controls.push_back({static_cast<int>(body), held, held, held, 0});
    }
    return build_world(scene);
}

/// Tilts slowly to the slope, so that nothing sways, and waits there.
void tilt(World& world, double slope, double tilting, double end) {
    while (world.time < end) {
        const double angle = slope * std::min(1.0, world.time / tilting);
        world.gravity = {gravity * std::sin(angle), -gravity * std::cos(angle)};
        step(world);
    }
}

TEST(BlockOnSlope, StaysWhereFrictionSuffices) {
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double mu = std::tan(30.0 * std::numbers::pi / 180.0);
        World world = block_on(ground, 0.2, 0.05, 0.0, 30.0);
        const BodyIndex block = body_of_id(world, 1);
        const double start = world.bodies[block].x;
        tilt(world, std::atan(0.97 * mu), 0.5, 1.5);
        // The springs of both bottom corners carry the slope's pull, mg sin θ / 2k_s; the block also leans over by the
        // difference of their normal springs and slips a little where the upper corner is relieved.
        const double creep = world.bodies[block].x - start;
        const double sag = world.inertia[block].mass * gravity * std::sin(std::atan(0.97 * mu)) / (2.0 * 0.5e8);
        fmt::print("  {}: moved {:.3g} m, elastic share {:.3g} m, speed {:.3g} m/s\n", name_of(ground), creep, sag,
                   world.bodies[block].vx);
        EXPECT_LT(creep, 4.0 * sag);
        EXPECT_LT(std::abs(world.bodies[block].vx), 1e-9);
    }
}

TEST(BlockOnSlope, SlidesWithTheClosedFormWhereItDoesNot) {
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double slope = 35.0 * std::numbers::pi / 180.0, mu = std::tan(20.0 * std::numbers::pi / 180.0);
        World world = block_on(ground, 0.2, 0.05, slope, 20.0);
        const BodyIndex block = body_of_id(world, 1);
        while (world.time < 0.1) step(world);
        const double v0 = world.bodies[block].vx, t0 = world.time;
        while (world.time < 0.7) step(world);
        const double expected = gravity * (std::sin(slope) - mu * std::cos(slope));
        EXPECT_TRUE(agrees(fmt::format("acceleration on a {}", name_of(ground)),
                           (world.bodies[block].vx - v0) / (world.time - t0), expected, 1e-3));
        EXPECT_LT(std::abs(world.bodies[block].angle), 1e-3);
    }
}

TEST(BlockOnSlope, TopplesWhereItsWeightPassesBeyondItsLowerCorner) {
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double edge = std::atan(0.05 / 0.2);  // width over height
        World stays = block_on(ground, 0.05, 0.2, 0.0, 40.0), falls = block_on(ground, 0.05, 0.2, 0.0, 40.0);
        tilt(stays, 0.995 * edge, 1.0, 3.0);
        tilt(falls, 1.005 * edge, 1.0, 1.0);
        while (falls.time < 3.0 && std::abs(falls.bodies[body_of_id(falls, 1)].angle) < 0.5) step(falls);
        const double turned = std::abs(stays.bodies[body_of_id(stays, 1)].angle);
        fmt::print("  {}: at 0.995 of the edge turned {:.3g} rad, at 1.005 turned 0.5 rad after {:.3g} s\n",
                   name_of(ground), turned, falls.time);
        EXPECT_LT(turned, 1e-3);
        EXPECT_LT(falls.time, 3.0);
    }
}

}  // namespace
}  // namespace crackle
