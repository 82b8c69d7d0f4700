// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/geometry/contact_share.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/geometry/facing_edges.hpp"
#include "solver/geometry/geometry.hpp"

namespace crackle {
namespace {

bool held(const World& world, BodyIndex b) {
    return world.bodies.inertia[b].inverse_mass_x == 0.0 && world.bodies.inertia[b].inverse_mass_y == 0.0;
}

/// Radius of a disc with the area of the body, m. It is 0 for a held body, and the bounding radius for an open chain.
double equivalent_radius(const World& world, BodyIndex b) {
    if (held(world, b)) return 0.0;
    const BodyInfo info = world.bodies.info(b);
    if (info.single_circle) return world.bodies.state[b].shape[0];
    if (info.piece_count > 0 && !info.closed) return info.reach;
    const double area = world.bodies.inertia[b].mass / world.settings.materials[info.material].density;
    return std::sqrt(area / std::numbers::pi);
}

Vec2 centre_of(const World& world, BodyIndex b) { return {world.bodies.state[b].x, world.bodies.state[b].y}; }

/// Half the sum of the lengths of the two edges that meet at a corner, m.
double length_of_corner(const World& world, BodyIndex b, std::uint32_t element) {
    const BodyInfo info = world.bodies.info(b);
    const std::uint32_t n = info.element_count, k = element - info.first_element;
    const auto place = [&](std::uint32_t e) {
        const Element& corner = world.bodies.elements[info.first_element + e % n];
        return Vec2{corner.x, corner.y};
    };
    double sum = 0.0;
    if (info.closed || k > 0) sum += norm(place(k) - place(k + n - 1));
    if (info.closed || k + 1 < n) sum += norm(place(k + 1) - place(k));
    return 0.5 * sum;
}

/// Diameter of a circle element, or half the sum of the two edge lengths at a corner, m.
double length_of(const World& world, BodyIndex b, std::uint32_t element) {
    return world.bodies.info(b).piece_count > 0 ? length_of_corner(world, b, element)
                                                : 2.0 * element_of(BodyView(world), b, element).radius;
}

}  // namespace

ContactShare share_of_contact(const World& world, PointKind kind, const ContactPoint& point) {
    ContactShare share;
    share.distance = equivalent_radius(world, point.body_i);
    if (kind == PointKind::face_face) {
        share.length = 1.0;
        share.distance += equivalent_radius(world, point.body_j);
        return share;
    }
    share.length = length_of(world, point.body_i, point.element_i);
    if (kind == PointKind::element_wall) return share;
    share.distance += equivalent_radius(world, point.body_j);
    const bool circles = kind == PointKind::circle_circle || kind == PointKind::element_element;
    if (circles) share.length = std::min(share.length, length_of(world, point.body_j, point.feature_j));
    return share;
}

std::optional<ContactShare> share_of_face(const World& world, BodyIndex i, BodyIndex j, double gap) {
    const bool swapped = world.bodies.info(i).id > world.bodies.info(j).id;
    if (swapped) std::swap(i, j);
    const std::vector<OutsetEdge> edges_i = outset_edges(corners_of(world, i), 0.5 * gap),
                                  edges_j = outset_edges(corners_of(world, j), 0.5 * gap);
    ContactShare share;
    Vec2 outwards;
    Vec2 on_face;
    for (const OutsetEdge& a : edges_i) {
        for (const OutsetEdge& b : edges_j) {
            const FacingPart part = facing_part(a, b, gap);
            const double length = std::max(0.0, part.to - part.from);
            if (length <= share.length) continue;
            share.length = length;
            share.edge_i = static_cast<std::uint32_t>(&a - edges_i.data());
            share.edge_j = static_cast<std::uint32_t>(&b - edges_j.data());
            const OutsetEdge& of_held = held(world, i) ? a : b;
            outwards = of_held.outwards();
            on_face = of_held.start;
        }
    }
    if (share.length == 0.0) return std::nullopt;
    if (swapped) std::swap(share.edge_i, share.edge_j);
    const Vec2 centre_i = centre_of(world, i), centre_j = centre_of(world, j);
    share.distance = held(world, i)   ? std::abs(dot(centre_j - on_face, outwards))
                     : held(world, j) ? std::abs(dot(centre_i - on_face, outwards))
                                      : norm(centre_j - centre_i);
    return share;
}

}  // namespace crackle
