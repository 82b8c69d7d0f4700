// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/controls.hpp"

#include <algorithm>

namespace crackle {
namespace {

double& velocity_of(BodyState& body, int dof) { return dof == 0 ? body.vx : dof == 1 ? body.vy : body.omega; }
double& position_of(BodyState& body, int dof) { return dof == 0 ? body.x : dof == 1 ? body.y : body.angle; }
double& inverse_of(BodyInertia& inertia, int dof) {
    return dof == 0 ? inertia.inverse_mass_x : dof == 1 ? inertia.inverse_mass_y : inertia.inverse_moment;
}

bool held(const DofControl& dof) { return dof.drive == Drive::velocity || dof.drive == Drive::displacement; }

double ramp_velocity(const ControlState& control, int dof, std::int64_t step, double time_step) {
    const bool over = step >= control.first_step + control.ramp_steps;
    return over ? 0.0 : control.dof[dof].value / (static_cast<double>(control.ramp_steps) * time_step);
}

/// Position prescribed by a ramp at step number `step`: x_0 + value·n/N.
double ramp_position(const ControlState& control, int dof, std::int64_t step) {
    const std::int64_t n = std::min(step - control.first_step, control.ramp_steps);
    return control.start[dof] +
           control.dof[dof].value * static_cast<double>(n) / static_cast<double>(control.ramp_steps);
}

/// Sets a prescribed velocity. The drive supplies the change of kinetic energy instantaneously, so it counts as
/// displacement work. The force is an impulse and does not appear in the reaction.
void set_velocity(World& world, BodyIndex b, int dof, double velocity) {
    double& now = velocity_of(world.bodies.state[b], dof);
    const double weight = dof < 2 ? world.bodies.inertia[b].mass : world.bodies.info(b).moment;
    if (world.account.begun) world.account.displacement_work += 0.5 * weight * (velocity * velocity - now * now);
    now = velocity;
}

void enter(World& world, ControlState& control) {
    BodyState& body = world.bodies.state[control.body];
    BodyInertia& inertia = world.bodies.inertia[control.body];
    const BodyInfo info = world.bodies.info(control.body);
    for (int d = 0; d < 3; ++d) {
        control.start[d] = position_of(body, d);
        control.last_force[d] = 0.0;
        control.last_move[d] = 0.0;
        inverse_of(inertia, d) = held(control.dof[d]) ? 0.0 : d < 2 ? 1.0 / inertia.mass : 1.0 / info.moment;
        if (control.dof[d].drive == Drive::velocity) set_velocity(world, control.body, d, control.dof[d].value);
        if (control.dof[d].drive == Drive::displacement) {
            set_velocity(world, control.body, d,
                         ramp_velocity(control, d, world.stepping.steps, world.stepping.time_step));
        }
    }
}

}  // namespace

void build_controls(World& world, const Scene& scene, const std::vector<BodyIndex>& internal_of) {
    for (const Control& control : scene.controls) {
        const DofControl dof[3] = {control.x, control.y, control.rotation};
        set_control(world, internal_of[static_cast<std::size_t>(control.body)], dof, control.ramp_steps);
    }
}

void set_control(World& world, BodyIndex body, const DofControl (&dof)[3], std::int64_t ramp_steps) {
    ControlState fresh{};
    fresh.body = body;
    std::copy(std::begin(dof), std::end(dof), std::begin(fresh.dof));
    fresh.first_step = world.stepping.steps;
    fresh.ramp_steps = ramp_steps;
    auto place = std::find_if(world.bodies.controls.begin(), world.bodies.controls.end(),
                              [&](const ControlState& c) { return c.body == body; });
    if (place == world.bodies.controls.end())
        place = world.bodies.controls.insert(world.bodies.controls.end(), fresh);
    else
        *place = fresh;
    enter(world, *place);
    world.workers.plan.valid = false;
    world.bodies.forces_clear = false;
}

bool driven_at_velocity(const World& world, BodyIndex body, int dof) {
    return std::ranges::any_of(world.bodies.controls, [&](const ControlState& control) {
        return control.body == body && control.dof[dof].drive == Drive::velocity;
    });
}

void change_velocity(World& world, BodyIndex body, int dof, double velocity) {
    for (ControlState& control : world.bodies.controls) {
        if (control.body != body) continue;
        control.dof[dof].value = velocity;
        set_velocity(world, body, dof, velocity);
    }
}

void relax_drives(World& world) {
    for (ControlState& control : world.bodies.controls)
        for (int d = 0; d < 3; ++d)
            if (control.dof[d].drive == Drive::force)
                control.start[d] = position_of(world.bodies.state[control.body], d);
}

void account_controls(World& world) {
    for (ControlState& control : world.bodies.controls) {
        const BodyForce& contact = world.bodies.force[control.body];
        const double mass = world.bodies.inertia[control.body].mass;
        const double load[3] = {contact.fx + mass * world.settings.gravity.x,
                                contact.fy + mass * world.settings.gravity.y, contact.torque};
        for (int d = 0; d < 3; ++d) {
            if (control.dof[d].drive == Drive::free) continue;
            const bool reacts = held(control.dof[d]);
            const double force = reacts ? -load[d] : control.force(d, world.bodies.state[control.body]);
            const double work = 0.5 * (control.last_force[d] + force) * control.last_move[d];
            (reacts ? world.account.displacement_work : world.account.force_work) += work;
            control.last_force[d] = force;
        }
    }
}

void kick_controls(World& world, double kick) {
    for (ControlState& control : world.bodies.controls) {
        BodyState& body = world.bodies.state[control.body];
        for (int d = 0; d < 3; ++d) {
            if (control.dof[d].drive == Drive::force) {
                velocity_of(body, d) +=
                    kick * control.force(d, body) * inverse_of(world.bodies.inertia[control.body], d);
            } else if (control.dof[d].drive == Drive::displacement) {
                set_velocity(world, control.body, d,
                             ramp_velocity(control, d, world.stepping.steps, world.stepping.time_step));
            }
        }
    }
}

void place_controls(World& world) {
    for (ControlState& control : world.bodies.controls) {
        BodyState& body = world.bodies.state[control.body];
        for (int d = 0; d < 3; ++d) {
            // Places the body exactly on the ramp. The body's outline has rotated by the same angle, up to round-off.
            if (control.dof[d].drive == Drive::displacement)
                position_of(body, d) = ramp_position(control, d, world.stepping.steps);
            control.last_move[d] = velocity_of(body, d) * world.stepping.drift;
        }
    }
}

}  // namespace crackle
