// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/displace.hpp"

#include <algorithm>
#include <cmath>

#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"

namespace crackle {
namespace {

constexpr double share_of_a_step = 0.1;

/// Sets the velocities of driven degrees of freedom to `motion` multiplied by `times`.
void drive_parts(World& world, const std::vector<BodyMotion>& motion, double times) {
    const std::vector<ControlState> controls = world.bodies.controls;
    for (const ControlState& control : controls) {
        const BodyMotion& way = motion[control.body];
        const double along[3] = {way.x, way.y, way.rotation};
        for (int d = 0; d < 3; ++d)
            if (control.dof[d].drive == Drive::velocity) change_velocity(world, control.body, d, times * along[d]);
    }
}

/// Moves all bodies by a fraction of `way` in one step of the integrator, without forces.
void drift(World& world, const std::vector<BodyMotion>& way, double share) {
    compute_forces(world);
    set_velocities(world, way, share / world.stepping.time_step);
    std::ranges::fill(world.bodies.force, BodyForce{});
    drive_parts(world, way, share / world.stepping.time_step);
    advance(world);
    compute_forces(world);
}

/// Removes the loads on driven bodies while this object exists.
class WithoutLoads {
  public:
    explicit WithoutLoads(World& world) : world_(world), controls_(world.bodies.controls) {
        for (ControlState& control : world.bodies.controls)
            for (DofControl& dof : control.dof)
                if (dof.drive == Drive::force) dof.value = dof.stiffness = 0.0;
    }
    ~WithoutLoads() {
        for (std::size_t k = 0; k < controls_.size(); ++k)
            for (int d = 0; d < 3; ++d)
                if (controls_[k].dof[d].drive == Drive::force) world_.bodies.controls[k].dof[d] = controls_[k].dof[d];
    }
    WithoutLoads(const WithoutLoads&) = delete;
    WithoutLoads& operator=(const WithoutLoads&) = delete;

  private:
    World& world_;
    std::vector<ControlState> controls_;
};

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

void displace(World& world, const std::vector<BodyMotion>& way) {
    double farthest = 0.0;
    for (const BodyMotion& one : way) farthest = std::max(farthest, std::hypot(one.x, one.y));
    const auto step = world.stepping.steps;
    const double time = world.stepping.time, kick_share = world.stepping.kick_share;
    const double parts = std::max(1.0, std::ceil(farthest / (share_of_a_step * world.list.fastest_allowed_move)));
    {
        const WithoutLoads aside(world);
        for (double part = 0.0; part < parts; ++part) drift(world, way, 1.0 / parts);
    }
    set_velocities(world, std::vector<BodyMotion>(way.size()), 0.0);
    drive_parts(world, std::vector<BodyMotion>(way.size()), 0.0);
    compute_forces(world);
    // The displacement must not count as work of the driven parts.
    for (ControlState& control : world.bodies.controls) std::ranges::fill(control.last_move, 0.0);
    world.stepping.steps = step;
    world.stepping.time = time;
    world.stepping.kick_share = kick_share;
    world.stepping.drift = 0.0;
}

}  // namespace crackle
