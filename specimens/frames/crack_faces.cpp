// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/crack_faces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace crackle {
namespace {

/// Part of a face at the start of loading: its ends as coordinates along a unit vector, m, relative to the point where
/// the bond is attached.
struct Stretch {
    Vec2 along;
    double begin, end;
};

double smaller_radius(const World& world, PointKind kind, const ContactPoint& point) {
    const BodyView bodies(world);
    const double radius = element_of(bodies, point.body_i, point.element_i).radius;
    if (!is_circles(world, point.body_j)) return radius;
    const bool named = kind == PointKind::element_element;
    const std::uint32_t partner = named ? point.feature_j : world.bodies.info(point.body_j).first_element;
    return std::min(radius, element_of(bodies, point.body_j, partner).radius);
}

Vec2 middle_of(const Facing& facing) { return 0.5 * (facing.on_i + facing.on_j); }

/// The point of `places` that is farthest from `from`.
Vec2 farthest(const std::vector<Vec2>& places, Vec2 from) {
    return *std::max_element(places.begin(), places.end(),
                             [&](Vec2 a, Vec2 b) { return norm(a - from) < norm(b - from); });
}

/// Part of an interface's face that belongs to a bond. Bonds between the same two bodies are adjacent in the list of
/// bonds.
template <PointKind K>
Stretch interface_share(const World& world, const TestSetup& setup, PointIndex bond, const Facing& held) {
    const BondRecord& bonds = setup.bonds;
    const auto belongs = [&](PointIndex k) { return same_pair(bonds.points[k], bonds.points[bond]); };
    const auto number = static_cast<std::size_t>(K);
    PointIndex first = bond, last = bond + 1;
    while (first > bonds.kind_begin[number] && belongs(first - 1)) --first;
    while (last < bonds.kind_begin[number + 1] && belongs(last)) ++last;
    std::vector<Vec2> places;
    for (PointIndex k = first; k < last; ++k)
        places.push_back(middle_of(facing_at_start<K>(world, setup, bonds.points.at<K>(k))));
    const Vec2 from = middle_of(held), one = farthest(places, from), other = farthest(places, one);
    // If two corners face each other, the contact normal is not the face's normal, so the face's direction follows from
    // its points.
    const double length = norm(other - one), least = bonds.thick;
    const Vec2 along = length > least ? (1.0 / length) * (other - one) : perpendicular(held.normal);
    double begin = 0.0, end = 0.0;
    int before = 0;
    for (PointIndex k = first; k < last; ++k) {
        const double place = dot(places[k - first] - from, along);
        begin = std::min(begin, place);
        end = std::max(end, place);
        if (std::pair(place, k) < std::pair(0.0, bond)) ++before;
    }
    const double lacking = std::max(0.0, least - (end - begin));
    begin -= 0.5 * lacking;
    const double share = (end + 0.5 * lacking - begin) / (last - first);
    return {along, begin + before * share, begin + (before + 1) * share};
}

double flat_face_lap_at_start(const World& world, const BondRecord& bonds, const ContactPoint& point) {
    const auto body = [&](BodyIndex b) {
        const StartPlace& start = bonds.start[b];
        return placed_body(world, bonds, b, start.x, start.y, start.angle);
    };
    return flat_face_contact(world.bodies.flat_faces[point.element_i], world.bodies.flat_faces[point.feature_j],
                             body(point.body_i), body(point.body_j))
        .lap();
}

/// Part of the face that belongs to a bond. @param held  where the bond is attached at the start of loading
template <PointKind K>
Stretch share_of(const World& world, const TestSetup& setup, PointIndex bond, const Facing& held) {
    const ContactPoint point = setup.bonds.points.at<K>(bond);
    if constexpr (K == PointKind::bonded_face) {
        const double half = 0.5 * world.faces.springs[point.element_i].length;
        return {perpendicular(held.normal), -half, half};
    }
    if constexpr (K == PointKind::face_face) {
        const double half = 0.5 * flat_face_lap_at_start(world, setup.bonds, point);
        return {perpendicular(held.normal), -half, half};
    }
    if (!is_circles(world, point.body_i)) return interface_share<K>(world, setup, bond, held);
    const double radius = smaller_radius(world, K, point);
    return {perpendicular(held.normal), -radius, radius};
}

template <PointKind K>
CrackFace face_of(const PlacedFrame& placed, PointIndex bond) {
    const TestSetup& setup = placed.setup();
    const ContactPoint point = setup.bonds.points.at<K>(bond);
    const Facing held = facing_at_start<K>(placed.world(), setup, point);
    const Stretch part = share_of<K>(placed.world(), setup, bond, held);
    const auto carried = [&](double place) {
        return 0.5 * (placed.carried(point.body_i, held.on_i + place * part.along) +
                      placed.carried(point.body_j, held.on_j + place * part.along));
    };
    const Vec2 normal =
        rotated(placed.turn(point.body_i), held.normal) + rotated(placed.turn(point.body_j), held.normal);
    const Vec2 apart = placed.carried(point.body_j, held.on_j) - placed.carried(point.body_i, held.on_i);
    const double length = norm(normal);
    const double now = length > 0.0 ? dot(apart, normal) / length : norm(apart);
    const double touching = K == PointKind::bonded_face ? 0.0  // attached where the two faces met
                            : setup.specimen.polygons
                                ? setup.bonds.thick
                                : setup.bonds.overlaps[bond];  // m, value of `now` when the surfaces just touch
    return {carried(part.begin), carried(part.end), now - touching};
}

/// Calls `visit<K>()` with the kind K of a bond. Walls have no bonds.
template <class Visit>
void with_kind_of(const BondRecord& bonds, PointIndex bond, Visit&& visit) {
    visit_kinds(bonds.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        if constexpr (K != PointKind::element_wall) {
            if (bond >= begin && bond < end) visit.template operator()<K>();
        }
    });
}

}  // namespace

CrackFace find_crack_face(const PlacedFrame& placed, PointIndex bond) {
    CrackFace face{};
    with_kind_of(placed.setup().bonds, bond, [&]<PointKind K>() { face = face_of<K>(placed, bond); });
    return face;
}

double length_of_face(const World& world, const TestSetup& setup, PointIndex bond) {
    double length = 0.0;
    with_kind_of(setup.bonds, bond, [&]<PointKind K>() {
        const Facing held = facing_at_start<K>(world, setup, setup.bonds.points.at<K>(bond));
        const Stretch part = share_of<K>(world, setup, bond, held);
        length = part.end - part.begin;
    });
    return length;
}

}  // namespace crackle
