// SPDX-License-Identifier: GPL-3.0-or-later
// Time, position and bodies of a bond event: the fields that BreakEvent and SlipEvent have in common.
// Tested by tests/solver/stepping/record_breaks_test.cpp.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Angle of the line along a normal, rad, in (-π/2, π/2]; it is the same for opposite normals.
inline double orientation_of(Vec2 normal) {
    double angle = correctly_rounded::atan2(normal.y, normal.x);
    if (angle > 0.5 * std::numbers::pi) angle -= std::numbers::pi;
    if (angle <= -0.5 * std::numbers::pi) angle += std::numbers::pi;
    return angle;
}

/// Creates an event and sets the common fields. @tparam Event either BreakEvent or SlipEvent
template <class Event>
Event event_at(const World& world, BodyIndex body_i, BodyIndex body_j, Vec2 position, Vec2 normal) {
    Event event{};
    event.step = world.stepping.steps;
    event.time = world.stepping.time;
    event.body_i = world.bodies.names[body_i].id;
    event.body_j = world.bodies.names[body_j].id;
    event.position = position;
    event.orientation = orientation_of(normal);
    return event;
}

}  // namespace crackle
