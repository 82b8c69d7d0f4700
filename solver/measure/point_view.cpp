// SPDX-License-Identifier: GPL-3.0-or-later
// Values read from a world: all values of one contact point, forces on walls, positions of elements in input order.

#include <fmt/format.h>

#include <stdexcept>

#include "solver/base/errors.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/overlap_gradient.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

PointKind kind_of(const World& world, PointIndex k) {
    int kind = 0;
    while (k >= world.points.kind_begin[static_cast<std::size_t>(kind) + 1]) ++kind;
    return static_cast<PointKind>(kind);
}

ContactGeometry geometry_of(const BodyView& bodies, PointKind kind, const ContactPoint& point) {
    std::uint32_t feature = point.feature_j;
    switch (kind) {
        case PointKind::circle_circle:
            return contact_geometry<PointKind::circle_circle>(bodies, point, feature);
        case PointKind::element_element:
            return contact_geometry<PointKind::element_element>(bodies, point, feature);
        case PointKind::element_outline:
            return contact_geometry<PointKind::element_outline>(bodies, point, feature);
        case PointKind::face_face:
            return contact_geometry<PointKind::face_face>(bodies, point, feature);
        case PointKind::disc_segment:
            return contact_geometry<PointKind::disc_segment>(bodies, point, feature);
        case PointKind::segment_segment:
            return contact_geometry<PointKind::segment_segment>(bodies, point, feature);
        case PointKind::bonded_face:
            return contact_geometry<PointKind::bonded_face>(bodies, point, feature);
        case PointKind::element_wall:
            break;
    }
    return contact_geometry<PointKind::element_wall>(bodies, point, feature);
}

}  // namespace

ContactGeometry geometry_at(const World& world, PointIndex k) {
    return geometry_of(BodyView(world), kind_of(world, k), world.points.contact[k]);
}

std::pair<PointIndex, PointIndex> points_between(const World& world, PointIndex k) {
    const auto belongs = [&](PointIndex other) {
        return same_pair(world.points.contact[other], world.points.contact[k]);
    };
    PointIndex begin = k, end = k + 1;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    while (begin > 0 && belongs(begin - 1)) --begin;
    while (end < walls && belongs(end)) ++end;
    return {begin, end};
}

double overlap_of(const World& world, PointIndex k) { return geometry_at(world, k).overlap; }

PointView view_point(const World& world, PointIndex k) {
    const ContactPoint point = world.points.contact[k];
    const ContactLaw law = law_of(world, k);
    PointView view{};
    view.kind = kind_of(world, k);
    const ContactGeometry g = geometry_of(BodyView(world), view.kind, point);
    const BodyState& body = world.bodies.state[point.body_i];
    view.body_i = point.body_i;
    view.body_j = point.body_j;
    view.overlap = g.overlap;
    view.normal = {g.nx, g.ny};
    view.arm_i = {g.aix, g.aiy};
    view.arm_j = {g.ajx, g.ajy};
    view.overlap_gradient = by_guide(view.kind) ? guide_gradient(world, view.kind, point)
                                                : closing_gradient(view.normal, view.arm_i, view.arm_j);
    view.position = {body.x + g.aix, body.y + g.aiy};
    view.bonded = (world.points.state[k].flags & point_bonded) != 0;
    view.closed_joint = (world.points.state[k].flags & point_closed) != 0;
    view.touching = view.bonded || g.overlap > world.points.bond_overlap[k];
    view.sliding = (world.points.state[k].flags & point_sliding) != 0;
    view.slid = (world.points.state[k].flags & point_slid) != 0;
    view.normal_stiffness = law.normal_stiffness;
    view.sticks = law.friction > 0.0 || (view.bonded && facts_of(world.settings.bond_law).sticks);
    view.shear_stiffness = view.sticks ? law.shear_stiffness : 0.0;
    view.friction = law.friction;
    view.bond_overlap = world.points.bond_overlap[k];
    view.normal_force = view.touching ? law.normal_stiffness * (g.overlap - world.points.bond_overlap[k]) : 0.0;
    view.shear_force = view.touching ? world.points.shear_force[k] : 0.0;
    return view;
}

BodyIndex body_of_id(const World& world, int id) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (world.bodies.info(b).id == id) return static_cast<BodyIndex>(b);
    }
    throw InputError(fmt::format("body {}: found no body with this number, expected one of the {} bodies of this scene",
                                 id, world.bodies.size()));
}

void forget_point_forces(World& world) {
    world.points.keep_forces = false;
    Array<PointForce>().swap(world.points.force);  // assigning `{}` would not free the memory
}

std::array<Vec2, 4> measure_wall_forces(const World& world) {
    if (!world.points.keep_forces)
        throw std::logic_error("measure_wall_forces: this world does not store point forces");
    std::array<Vec2, 4> sums{};
    for (PointIndex k = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
         k < world.points.size(); ++k) {
        Vec2& sum = sums[world.points.contact[k].body_j];
        sum = sum - Vec2{world.points.force[k].fx, world.points.force[k].fy};
    }
    return sums;
}

std::vector<Vec2> element_positions(const World& world, BodyIndex body) {
    const BodyInfo info = world.bodies.info(body);
    const BodyState& state = world.bodies.state[body];
    std::vector<Vec2> positions;
    positions.reserve(info.element_count);
    const BodyView bodies(world);
    for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e) {
        positions.push_back(Vec2{state.x, state.y} + turned(state, element_of(bodies, body, e)));
    }
    return positions;
}

}  // namespace crackle
