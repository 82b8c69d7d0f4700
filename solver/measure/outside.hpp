// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a body has passed through a wall of the domain.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstddef>

#include "solver/world/world.hpp"

namespace crackle {

/// Whether the centroid of a body lies beyond a wall, in a direction in which the body is free to move. Held bodies,
/// such as a container or a platen behind the wall, may lie anywhere.
inline bool outside_domain(const World& world, std::size_t b) {
    const Domain& d = world.settings.domain;
    const BodyState& body = world.bodies.state[b];
    const BodyInertia& inertia = world.bodies.inertia[b];
    const bool out_x = (d.wall_present[0] && body.x < d.x1) || (d.wall_present[1] && body.x > d.x2);
    const bool out_y = (d.wall_present[2] && body.y < d.y1) || (d.wall_present[3] && body.y > d.y2);
    return (out_x && inertia.inverse_mass_x > 0.0) || (out_y && inertia.inverse_mass_y > 0.0);
}

}  // namespace crackle
