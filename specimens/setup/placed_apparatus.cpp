// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/placed_apparatus.hpp"

#include <cstddef>

#include "solver/measure/point_view.hpp"

namespace crackle {

PlacedApparatus place_apparatus(const World& world, const Platens& platens, LoadingKind kind) {
    const Apparatus& given = platens.apparatus;
    PlacedApparatus placed;
    placed.kind = kind;
    placed.uniaxial = test_kind(kind).uniaxial;
    placed.compression = test_kind(kind).compression;
    placed.axis = given.axis;
    placed.section = given.section;
    placed.length = given.length;
    placed.stress_intensity = given.stress_intensity;
    placed.span = given.span;
    placed.normal_force = given.normal_force;
    placed.normal_spring = given.normal_spring;
    placed.bottom_id = platens.bottom_id;
    placed.top_id = platens.top_id;
    placed.bottom = body_of_id(world, platens.bottom_id);
    placed.top = body_of_id(world, platens.top_id);
    for (int id = platens.bottom_id; id <= platens.top_id; ++id) {
        const auto number = static_cast<std::size_t>(id - platens.bottom_id);
        const bool wall = platens.walls && id != platens.bottom_id && id != platens.top_id;
        placed.parts.push_back({body_of_id(world, id), given.parts.empty() ? 2 : given.parts[number].face, wall});
    }
    placed.strains_begin_at(world);
    return placed;
}

double PlacedApparatus::axial_strain(const World& world) const {
    const double now = axis == 1 ? world.bodies.state[top].y : world.bodies.state[top].x;
    return (compression ? top_start - now : now - top_start) / length;  // avoids -0 at the start
}

void PlacedApparatus::strains_begin_at(const World& world) {
    const BodyState& driver = world.bodies.state[top];
    top_start = axis == 1 ? driver.y : driver.x;
    top_height = driver.y;
}

PartForces forces_on_parts(const World& world, const PlacedApparatus& apparatus) {
    const auto on = [&](BodyIndex part) {
        const BodyForce& force = world.bodies.force[part];
        return apparatus.axis == 1 ? force.fy : force.fx;
    };
    PartForces forces;
    for (const SetupPart& part : apparatus.parts) {
        if (part.wall) continue;
        (part.body == apparatus.top ? forces.driver : forces.supports) += on(part.body);
    }
    return forces;
}

}  // namespace crackle
