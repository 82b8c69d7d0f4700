// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry of a contact point: overlap, normal and contact position, for each kind of point.
//
// An element (circle, or vertex of a chain) faces a circle, an outline or a wall. With d the distance of the element's
// centre from the partner (signed, negative inside a closed outline), the overlap is
//     δ = r_a + r_b - d
//         circle-circle: the two radii; circle-outline: r and thick; vertex-outline: thick/2 for both
// the normal n = -∇d points from i to j, and the force acts midway between the two surfaces, at x + n(r_a - δ/2). This
// is the «rounded» law: d is continuously differentiable outside a convex outline, so the force has the potential ½k_n
// δ². Contacts that follow the DEMseg guide's segment law (guide_segments.hpp) and contacts of circles across a joint
// (flat_faces.hpp) are points of other kinds. Source: solver/MODEL.md 3.
#pragma once

#include <array>
#include <cstdint>

#include "solver/geometry/circle_geometry.hpp"
#include "solver/geometry/face_motion.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/geometry/guide_segments.hpp"
#include "solver/geometry/outline_geometry.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// Position of an element's centre relative to its body's centroid, in world axes, m. For bodies that are not single
/// circles.
inline Vec2 turned(const BodyState& body, const Element& element) {
    return {body.shape[0] * element.x - body.shape[1] * element.y,
            body.shape[1] * element.x + body.shape[0] * element.y};
}

/// Current position of the segment that begins at an element. @param centre position of its body's centroid in the
/// desired coordinates, m
inline Bar bar_of(const BodyView& bodies, const BodyState& body, std::uint32_t element, Vec2 centre) {
    const Edge& edge = bodies.segments[element];
    const double c = body.shape[0], s = body.shape[1];
    return {centre + Vec2{c * edge.x - s * edge.y, s * edge.x + c * edge.y},
            {c * edge.tx - s * edge.ty, s * edge.tx + c * edge.ty},
            edge.length};
}

/// Calls visit(bar, centre of the disc, radius, sense) for every disc that may touch a bare segment (bar) at a point.
/// The point follows the DEMseg guide's segment law. Positions are relative to i's centroid; sense is +1 if the disc
/// belongs to i, otherwise -1.
template <PointKind K, typename Visit>
inline void visit_discs(const BodyView& bodies, const ContactPoint& point, const BodyState& i, const BodyState& j,
                        Visit&& visit) {
    const Bar b = bar_of(bodies, j, point.feature_j, {j.x - i.x, j.y - i.y});
    if constexpr (K == PointKind::disc_segment) {
        const Element circle = element_of(bodies, point.body_i, point.element_i);
        visit(b, turned(i, circle), circle.radius + bodies.thick, 1.0);
    } else {
        const Bar a = bar_of(bodies, i, point.element_i, {});
        visit(b, a.start, bodies.thick, 1.0);
        visit(b, a.start + a.length * a.along, bodies.thick, 1.0);
        visit(a, b.start, bodies.thick, -1.0);
        visit(a, b.start + b.length * b.along, bodies.thick, -1.0);
    }
}

/// Contact of two bodies that consist of a single circle each.
inline CircleContact<double> single_circles_contact(const BodyState& i, const BodyState& j) {
    return circle_contact(j.x - i.x, j.y - i.y, i.shape[0], j.shape[0]);
}

/// Geometry of a point of kind K for the given states of bodies i and j (j is not used for a wall). For an outline,
/// sets `feature` to the edge that the element faces.
template <PointKind K>
inline ContactGeometry contact_geometry(const BodyView& bodies, const ContactPoint& point, const BodyState& i,
                                        const BodyState& j, std::uint32_t& feature) {
    if constexpr (K == PointKind::circle_circle) {
        return with_arms(single_circles_contact(i, j));
    } else if constexpr (K == PointKind::element_element) {
        const Element a = element_of(bodies, point.body_i, point.element_i);
        const Element b = element_of(bodies, point.body_j, point.feature_j);
        const Vec2 oi = turned(i, a), oj = turned(j, b);
        ContactGeometry g =
            with_arms(circle_contact((j.x - i.x) + (oj.x - oi.x), (j.y - i.y) + (oj.y - oi.y), a.radius, b.radius));
        g.aix += oi.x;
        g.aiy += oi.y;
        g.ajx += oj.x;
        g.ajy += oj.y;
        return g;
    } else if constexpr (K == PointKind::element_outline) {
        const Element a = element_of(bodies, point.body_i, point.element_i);
        const Vec2 oi = turned(i, a);
        const double wx = (i.x - j.x) + oi.x, wy = (i.y - j.y) + oi.y;
        const double cosine = j.shape[0], sine = j.shape[1];
        const OutlineFacing facing = face_outline(bodies, bodies.shape_of(point.body_j), point.feature_j,
                                                  cosine * wx + sine * wy, cosine * wy - sine * wx);
        feature = facing.edge;
        return outline_contact<double>({oi.x, oi.y, wx, wy, a.radius, a.radius + a.target_reach, cosine, sine}, facing);
    } else if constexpr (K == PointKind::face_face) {
        return flat_face_contact(bodies.flat_faces[point.element_i], bodies.flat_faces[point.feature_j], i, j);
    } else if constexpr (K == PointKind::bonded_face) {
        const FacePlace place = bodies.bond_faces->place[point.element_i];
        const BondFaceMotion m = motion_of(place, i, j);
        const Vec2 half = (0.5 * m.opening) * m.normal + (0.5 * m.sliding) * perpendicular(m.normal);
        const Vec2 arm_i = turned_by(i, place.arm_i) + half, arm_j = turned_by(j, place.arm_j) - half;
        return {-m.opening, m.normal.x, m.normal.y, arm_i.x, arm_i.y, arm_j.x, arm_j.y};
    } else if constexpr (by_guide(K)) {
        DiscResultant resultant;
        const auto visit = [&](auto&& add) { visit_discs<K>(bodies, point, i, j, add); };
        visit([&](const Bar& bar, Vec2 centre, double radius, double sense) {
            resultant.add(bar, centre, radius, sense);
        });
        const DiscResultant::Contact contact = resultant.contact(bodies.mean_of_discs, visit);
        return {contact.overlap, contact.normal.x,           contact.normal.y,          contact.at.x,
                contact.at.y,    contact.at.x - (j.x - i.x), contact.at.y - (j.y - i.y)};
    } else {
        const Element a = element_of(bodies, point.body_i, point.element_i);
        const Vec2 oi = turned(i, a);
        const double radius = point.feature_j == 1 ? 0.0 : a.radius;
        const Domain& domain = bodies.domain;
        ContactGeometry g{};
        double distance = 0.0;
        switch (static_cast<Wall>(point.body_j)) {
            case Wall::left:
                distance = (i.x - domain.x1) + oi.x;
                g.nx = -1.0;
                g.ny = 0.0;
                break;
            case Wall::right:
                distance = (domain.x2 - i.x) - oi.x;
                g.nx = 1.0;
                g.ny = 0.0;
                break;
            case Wall::bottom:
                distance = (i.y - domain.y1) + oi.y;
                g.nx = 0.0;
                g.ny = -1.0;
                break;
            case Wall::top:
                distance = (domain.y2 - i.y) - oi.y;
                g.nx = 0.0;
                g.ny = 1.0;
                break;
        }
        g.overlap = radius - distance;
        const double lift = radius - 0.5 * g.overlap;
        g.aix = oi.x + lift * g.nx;
        g.aiy = oi.y + lift * g.ny;
        g.ajx = 0.0;
        g.ajy = 0.0;
        return g;
    }
}

/// Geometry of a point of kind K at the current positions.
template <PointKind K>
inline ContactGeometry contact_geometry(const BodyView& bodies, const ContactPoint& point, std::uint32_t& feature) {
    const BodyState& i = bodies.state[point.body_i];
    return contact_geometry<K>(bodies, point, i, K == PointKind::element_wall ? i : bodies.state[point.body_j],
                               feature);
}

/// Overlap of a point of kind K at the current positions, m.
template <PointKind K>
inline double overlap_at(const BodyView& bodies, const ContactPoint& point) {
    std::uint32_t feature = point.feature_j;
    return contact_geometry<K>(bodies, point, feature).overlap;
}

/// Calls `visit.operator()<K>(begin, end)` with the range of points of each kind K. @param kind_begin index of the
/// first point of each kind, as in Points, or of each kind of bond
template <std::size_t N, class Visit>
inline void visit_kinds(const std::array<PointIndex, N>& kind_begin, Visit&& visit) {
    const auto of_kind = [&]<PointKind K>() {
        constexpr auto number = static_cast<std::size_t>(K);
        visit.template operator()<K>(kind_begin[number], kind_begin[number + 1]);
    };
    of_kind.template operator()<PointKind::circle_circle>();
    of_kind.template operator()<PointKind::element_element>();
    of_kind.template operator()<PointKind::element_outline>();
    of_kind.template operator()<PointKind::face_face>();
    of_kind.template operator()<PointKind::disc_segment>();
    of_kind.template operator()<PointKind::segment_segment>();
    of_kind.template operator()<PointKind::element_wall>();
    if constexpr (N == bond_kinds + 1) of_kind.template operator()<PointKind::bonded_face>();
    static_assert(point_kinds == 7 && bond_kinds == 8);
}

}  // namespace crackle
