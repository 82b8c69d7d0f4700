// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/displace.hpp"

#include <algorithm>
#include <cmath>

#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"

namespace crackle {
namespace {

constexpr double share_of_a_step = 0.1;

/// One drift with these velocities and without forces.
void drift(World& world, const TestSetup& setup, const std::vector<BodyMotion>& way, double share) {
    compute_forces(world);
    set_velocities(world, way, share / world.stepping.time_step);
    std::ranges::fill(world.bodies.force, BodyForce{});
    for (const BodyIndex platen : {setup.bottom, setup.top})
        change_velocity(world, platen, 1, share * way[platen].y / world.stepping.time_step);
    advance(world);
    compute_forces(world);
}

}  // namespace

void set_velocities(World& world, const std::vector<BodyMotion>& motion, double times) {
    for (std::size_t b = 0; b < motion.size(); ++b) {
        BodyState& body = world.bodies.state[b];
        body.vx = times * motion[b].x;
        body.vy = times * motion[b].y;
        body.omega = times * motion[b].rotation;
    }
    velocities_changed(world);
}

void displace(World& world, const TestSetup& setup, const std::vector<BodyMotion>& way) {
    double farthest = 0.0;
    for (const BodyMotion& one : way) farthest = std::max(farthest, std::hypot(one.x, one.y));
    const auto step = world.stepping.steps;
    const double time = world.stepping.time, kick_share = world.stepping.kick_share;
    const double parts = std::max(1.0, std::ceil(farthest / (share_of_a_step * world.list.fastest_allowed_move)));
    for (double part = 0.0; part < parts; ++part) drift(world, setup, way, 1.0 / parts);
    set_velocities(world, std::vector<BodyMotion>(way.size()), 0.0);
    for (const BodyIndex platen : {setup.bottom, setup.top}) change_velocity(world, platen, 1, 0.0);
    compute_forces(world);
    world.stepping.steps = step;
    world.stepping.time = time;
    world.stepping.kick_share = kick_share;
    world.stepping.drift = 0.0;
}

}  // namespace crackle
