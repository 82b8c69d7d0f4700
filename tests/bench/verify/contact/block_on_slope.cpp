// SPDX-License-Identifier: GPL-3.0-or-later
// A rectangular block on a slope: it stays at rest if tan θ < μ, otherwise it slides with a = g(sin θ - μ cos θ). It
// topples if its weight acts beyond its lower corner. The slope lies along x and gravity is rotated; the ground is a
// domain wall, a fixed segment or a fixed polygon.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace block_on_slope_scenes {
namespace {

constexpr double gravity = 9.81;
enum class Ground { wall, segment, polygon };

const char* name_of(Ground ground) {
    return ground == Ground::wall ? "wall" : ground == Ground::segment ? "segment" : "polygon";
}

/// A block of this width and height (m) at rest on its springs; its id is 1.
World block_on(Ground ground, double width, double height, double slope, double friction_angle) {
    Scene scene;
    Material material = rock(friction_angle, 0.5);
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
    return build_world(std::move(scene));
}

/// Tilts gravity slowly to the slope, so that the block does not swing, and waits there.
void tilt(World& world, double slope, double tilting, double end) {
    while (world.stepping.time < end) {
        const double angle = slope * std::min(1.0, world.stepping.time / tilting);
        world.settings.gravity = {gravity * std::sin(angle), -gravity * std::cos(angle)};
        step(world);
    }
}

std::vector<ClaimRow> block_stays_on_a_slope_below_friction() {
    Rows rows;
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double slope = std::atan(0.97 * std::tan(30.0 * std::numbers::pi / 180.0));
        World world = block_on(ground, 0.2, 0.05, 0.0, 30.0);
        const BodyIndex block = body_of_id(world, 1);
        const double start = world.bodies.state[block].x;
        tilt(world, slope, 0.5, 1.5);
        // The shear springs of both bottom corners carry the component of weight along the slope, which displaces the
        // block by mg sin θ / 2k_s. The block also tilts because its normal springs are compressed unequally, and slips
        // slightly where the upper corner is unloaded.
        const double sag = world.bodies.inertia[block].mass * gravity * std::sin(slope) / (2.0 * 0.5e8);
        rows.at_most(fmt::format("{}: displacement over that of its springs", name_of(ground)),
                     (world.bodies.state[block].x - start) / sag, 4.0, "springs and lean");
        rows.absolute(fmt::format("{}: speed, m/s", name_of(ground)), world.bodies.state[block].vx, 0.0, 1e-9, "rest");
    }
    return rows.take();
}

std::vector<ClaimRow> block_slides_on_a_slope_beyond_friction() {
    Rows rows;
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double slope = 35.0 * std::numbers::pi / 180.0, mu = std::tan(20.0 * std::numbers::pi / 180.0);
        World world = block_on(ground, 0.2, 0.05, slope, 20.0);
        const BodyIndex block = body_of_id(world, 1);
        while (world.stepping.time < 0.1) step(world);
        const double v0 = world.bodies.state[block].vx, t0 = world.stepping.time;
        while (world.stepping.time < 0.7) step(world);
        rows.relative(fmt::format("{}: acceleration, m/s2", name_of(ground)),
                      (world.bodies.state[block].vx - v0) / (world.stepping.time - t0),
                      gravity * (std::sin(slope) - mu * std::cos(slope)), 1e-3, "reference");
        rows.absolute(fmt::format("{}: turn, rad", name_of(ground)), world.bodies.state[block].angle, 0.0, 1e-3,
                      "lean of its springs");
    }
    return rows.take();
}

std::vector<ClaimRow> block_topples_past_its_edge() {
    Rows rows;
    for (const Ground ground : {Ground::wall, Ground::segment, Ground::polygon}) {
        const double edge = std::atan(0.05 / 0.2);  // rad; its tangent is width over height
        World stays = block_on(ground, 0.05, 0.2, 0.0, 40.0), falls = block_on(ground, 0.05, 0.2, 0.0, 40.0);
        tilt(stays, 0.995 * edge, 1.0, 3.0);
        tilt(falls, 1.005 * edge, 1.0, 1.0);
        while (falls.stepping.time < 3.0 && std::abs(falls.bodies.state[body_of_id(falls, 1)].angle) < 0.5) step(falls);
        rows.at_most(fmt::format("{}: turn at 0.995 of the edge, rad", name_of(ground)),
                     std::abs(stays.bodies.state[body_of_id(stays, 1)].angle), 1e-3, "lean of its springs");
        rows.at_most(fmt::format("{}: time to turn by 0.5 rad at 1.005 of the edge, s", name_of(ground)),
                     falls.stepping.time, 3.0 - 1e-9, "slow start");
    }
    return rows.take();
}

}  // namespace
}  // namespace block_on_slope_scenes

std::vector<Claim> block_on_slope_claims() {
    using namespace block_on_slope_scenes;
    constexpr const char* group = "One and two bodies";
    return {
        {.name = "block_stays_on_a_slope_below_friction",
         .group = group,
         .statement = "a block stays where tan θ < μ (here 0.97μ)",
         .check = block_stays_on_a_slope_below_friction},
        {.name = "block_slides_on_a_slope_beyond_friction",
         .group = group,
         .statement = "a = g(sin θ - μ cos θ)",
         .check = block_slides_on_a_slope_beyond_friction},
        {.name = "block_topples_past_its_edge",
         .group = group,
         .statement = "topples where tan θ > width/height",
         .check = block_topples_past_its_edge,
         .slow = true},
    };
}

}  // namespace crackle::verification
