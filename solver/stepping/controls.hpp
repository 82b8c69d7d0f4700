// SPDX-License-Identifier: GPL-3.0-or-later
// Driven bodies. Each driven degree of freedom is held, moved at a prescribed velocity, moved along a displacement
// ramp, or loaded with a prescribed force. The inverse mass of a degree of freedom with a prescribed displacement or
// velocity is 0, so the kernels need no branch for it.
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Transfers the scene's controls to the world. For driven motions, inverse masses become zero, velocities take their
/// prescribed values, and the positions at which ramps start are recorded.
/// @param internal_of the index in the world of each body of the scene
void build_controls(World& world, const Scene& scene, const std::vector<BodyIndex>& internal_of);
/// Drives a body from its current position on. The new control replaces the body's previous control.
void set_control(World& world, BodyIndex body, const DofControl (&dof)[3], std::int64_t ramp_steps);
/// Whether the most recently set control of a body has Drive::velocity in a degree of freedom. @param dof the degree of
/// freedom: 0 x, 1 y, 2 rotation
bool driven_at_velocity(const World& world, BodyIndex body, int dof);
/// Changes the prescribed velocity of a degree of freedom from the next drift on. The change of the body's kinetic
/// energy counts as displacement work. @param dof the degree of freedom (0 x, 1 y, 2 rotation), which must have
/// Drive::velocity
void change_velocity(World& world, BodyIndex body, int dof, double velocity);
/// Sets the zero position of each Drive::force spring to the current position of its body.
void relax_drives(World& world);
/// Adds the work done by the drives during the last drift, by the trapezoidal rule.
void account_controls(World& world);
/// Sets the velocities of driven bodies for the next drift. @param kick the length of the kick, s
void kick_controls(World& world, double kick);
/// Places bodies on displacement ramps exactly at the ramp's position, and records the displacement of every drive.
void place_controls(World& world);

}  // namespace crackle
