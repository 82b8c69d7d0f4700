// SPDX-License-Identifier: GPL-3.0-or-later
// Driven bodies: held or moved at a given velocity, moved along a ramp, or pushed by a given force, a degree of freedom
// each. A degree of freedom driven in displacement or velocity has inverse mass 0, so the bulk kernels need no branch
// for it.
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Enters the scene's controls into the world: zero inverse masses, prescribed velocities, starts of ramps.
/// @param internal_of body numbering: scene index to world index.
void build_controls(World& world, const Scene& scene, const std::vector<BodyIndex>& internal_of);
/// Drives a body again from the present position on (replacing what drove it before).
void set_control(World& world, BodyIndex body, const DofControl (&dof)[3], std::int64_t ramp_steps);
/// Whether the last control of a body has Drive::velocity in a degree of freedom: 0 x, 1 y, 2 rotation.
bool driven_at_velocity(const World& world, BodyIndex body, int dof);
/// Changes the prescribed velocity of a driven degree of freedom from the coming drift on; what that adds to the body's
/// kinetic energy is displacement work. @param dof 0 x, 1 y, 2 rotation; driven by Drive::velocity
void change_velocity(World& world, BodyIndex body, int dof, double velocity);
/// Springs of all drives by a force count from where their bodies are now.
void relax_drives(World& world);
/// Work of the drives over the last drift, by the trapezoidal rule.
void account_controls(World& world);
/// Velocities of the coming drift. @param kick length of the kick, s
void kick_controls(World& world, double kick);
/// Puts bodies on ramps exactly at the ramp's position, and notes how far every drive moved.
void place_controls(World& world);

}  // namespace crackle
