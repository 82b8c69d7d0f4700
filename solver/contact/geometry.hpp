// SPDX-License-Identifier: GPL-3.0-or-later
// Where two bodies meet: overlap, normal and contact position of one contact point, for each kind of point.
//
// An element (circle, or vertex of a chain) faces a circle, an outline or a wall. With d the distance of the element's
// centre from the partner (signed, negative inside a closed outline), the overlap is
//     δ = r_a + r_b - d         circle-circle: both radii; circle-outline: r and thick; vertex-outline: thick/2 twice
// the normal n = -∇d points from i to j, and the force acts midway between the two surfaces, at x + n(r_a - δ/2).
// This is the «rounded» law: d is C¹ outside a convex outline, so the force derives from ½k_n δ². The guide's law has
// kinds of its own, by guide_segments.hpp. Source: solver/MODEL.md 3.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/contact/guide_segments.hpp"
#include "solver/world/world.hpp"

namespace crackle {

struct ContactGeometry {
    double overlap;   // m
    double nx, ny;    // unit normal, from i to j
    double aix, aiy;  // m, arm from i's centroid to the contact position
    double ajx, ajy;  // m, from j's
};

/// Closest feature of an outline to a point of its body frame.
struct OutlineFacing {
    double distance;     // m, signed for closed pieces
    double gx, gy;       // unit gradient of the distance, body frame
    std::uint32_t edge;  // faced, into World::edges
};

/// m2; closer points are taken to coincide. Above, √s/s is 1/√s to rounding; the root and the division need not wait
/// for each other.
inline constexpr double least_squared_distance = std::numeric_limits<double>::min();

namespace detail {

/// An end of an edge, seen from `over` beyond it along the edge and `across` in front of its line.
inline OutlineFacing face_corner(double over, double across, const Edge& edge, std::uint32_t index) {
    const double squared = over * over + across * across, distance = std::sqrt(squared);
    // On the corner itself any direction of its normal cone will do; the edge's normal is one.
    if (!(squared >= least_squared_distance)) return {distance, edge.ty, -edge.tx, index};
    const double inverse = distance * (1.0 / squared);
    const double along = over * inverse, out = across * inverse;
    return {distance, along * edge.tx + out * edge.ty, along * edge.ty - out * edge.tx, index};
}

/// Unsigned distance to one open segment.
inline OutlineFacing face_segment(const Edge& edge, std::uint32_t index, double px, double py) {
    const double dx = px - edge.x, dy = py - edge.y;
    const double along = dx * edge.tx + dy * edge.ty;
    const double across = dx * edge.ty - dy * edge.tx;
    if (along <= 0.0) return face_corner(along, across, edge, index);
    if (along >= edge.length) return face_corner(along - edge.length, across, edge, index);
    return across >= 0.0 ? OutlineFacing{across, edge.ty, -edge.tx, index}
                         : OutlineFacing{-across, -edge.ty, edge.tx, index};
}

/// Signed distance to a convex closed piece by looking at every edge.
inline OutlineFacing face_every_edge(const Edge* edges, const Piece& piece, double px, double py) {
    OutlineFacing inside{-std::numeric_limits<double>::infinity(), 0.0, 0.0, 0};
    OutlineFacing outside{std::numeric_limits<double>::infinity(), 0.0, 0.0, 0};
    const std::uint32_t end = piece.first_edge + piece.edge_count;
    for (std::uint32_t e = piece.first_edge; e < end; ++e) {
        const Edge& edge = edges[e];
        const double dx = px - edge.x, dy = py - edge.y;
        const double across = dx * edge.ty - dy * edge.tx;
        if (across > inside.distance) inside = {across, edge.ty, -edge.tx, e};
        if (across <= 0.0) continue;  // the closest edge of an outside point is one that sees it
        const double along = dx * edge.tx + dy * edge.ty;
        OutlineFacing candidate{across, edge.ty, -edge.tx, e};
        if (along < 0.0) {
            candidate = face_corner(along, across, edge, e);
        } else if (along > edge.length) {
            candidate = face_corner(along - edge.length, across, edge, e);
        }
        if (candidate.distance < outside.distance) outside = candidate;
    }
    return inside.distance <= 0.0 ? inside : outside;
}

/// Signed distance to a convex closed piece, starting from the edge faced last. The normal strips of the edges and the
/// cones of the corners partition the outside of a convex outline, so a point found in one needs no further search.
/// A corner is where the edge faced says: the two that meet there agree to rounding.
inline OutlineFacing face_convex(const Edge* edges, const Piece& piece, std::uint32_t hint, double px, double py) {
    const std::uint32_t first = piece.first_edge, last = first + piece.edge_count - 1;
    std::uint32_t e = hint >= first && hint <= last ? hint : first;
    for (std::uint32_t tries = 0; tries < piece.edge_count; ++tries) {
        const Edge& edge = edges[e];
        const double dx = px - edge.x, dy = py - edge.y;
        const double across = dx * edge.ty - dy * edge.tx;
        if (across < 0.0) break;
        const double along = dx * edge.tx + dy * edge.ty;
        if (along >= 0.0 && along <= edge.length) return {across, edge.ty, -edge.tx, e};
        const bool before = along < 0.0;
        const double over = before ? along : along - edge.length;
        if (across + over * edge.cone[before ? 0 : 1] >= 0.0) return face_corner(over, across, edge, e);
        e = before ? (e == first ? last : e - 1) : (e == last ? first : e + 1);
    }
    return face_every_edge(edges, piece, px, py);
}

}  // namespace detail

/// Closest feature of a body's outline (minimum over its convex pieces and segments); `hint` is the edge faced last.
inline OutlineFacing face_outline(const World& world, const BodyInfo& body, std::uint32_t hint, double px, double py) {
    const Piece* pieces = world.bodies.pieces.data() + body.first_piece;
    const Edge* edges = world.bodies.edges.data();
    if (body.piece_count == 1 && pieces[0].closed) return detail::face_convex(edges, pieces[0], hint, px, py);
    OutlineFacing best{std::numeric_limits<double>::infinity(), 0.0, 0.0, 0};
    for (std::uint32_t p = 0; p < body.piece_count; ++p) {
        const OutlineFacing facing =
            pieces[p].closed ? detail::face_every_edge(edges, pieces[p], px, py)
                             : detail::face_segment(edges[pieces[p].first_edge], pieces[p].first_edge, px, py);
        if (facing.distance < best.distance) best = facing;
    }
    return best;
}

/// Element centre relative to the body's centroid, world axes. (A single circle's element sits at its centroid.)
inline Vec2 turned(const BodyState& body, const Element& element) {
    return {body.shape[0] * element.x - body.shape[1] * element.y,
            body.shape[1] * element.x + body.shape[0] * element.y};
}

namespace detail {

/// Two circles, the second `dx, dy` away from the first. Arms count from the circles' centres.
inline ContactGeometry circles_geometry(double dx, double dy, double ri, double rj) {
    const double squared = dx * dx + dy * dy, distance = std::sqrt(squared), inverse = distance * (1.0 / squared);
    const bool apart = squared >= least_squared_distance;
    ContactGeometry g;
    g.overlap = ri + rj - distance;
    g.nx = apart ? dx * inverse : 1.0;  // coincident centres have no normal: take the x axis
    g.ny = apart ? dy * inverse : 0.0;
    const double li = ri - 0.5 * g.overlap, lj = rj - 0.5 * g.overlap;
    g.aix = li * g.nx;
    g.aiy = li * g.ny;
    g.ajx = -lj * g.nx;
    g.ajy = -lj * g.ny;
    return g;
}

}  // namespace detail

/// The segment that begins at an element, as it lies now. @param centre of its body, m, in the frame wanted
inline Bar bar_of(const World& world, const BodyState& body, std::uint32_t element, Vec2 centre) {
    const Edge& edge = world.bodies.segments[element];
    const double c = body.shape[0], s = body.shape[1];
    return {centre + Vec2{c * edge.x - s * edge.y, s * edge.x + c * edge.y},
            {c * edge.tx - s * edge.ty, s * edge.tx + c * edge.ty},
            edge.length};
}

/// Calls visit(bar, disc's centre, radius, sense) for every disc of a point under the guide's law between bodies i and
/// j; positions count from i's centroid, sense is +1 for a disc of i.
template <PointKind K, typename Visit>
inline void visit_discs(const World& world, const ContactPoint& point, const BodyState& i, const BodyState& j,
                        Visit&& visit) {
    const Bar b = bar_of(world, j, point.feature_j, {j.x - i.x, j.y - i.y});
    if constexpr (K == PointKind::disc_segment) {
        const Element& circle = world.bodies.elements[point.element_i];
        visit(b, turned(i, circle), circle.radius + world.settings.thick, 1.0);
    } else {
        const Bar a = bar_of(world, i, point.element_i, {});
        visit(b, a.start, world.settings.thick, 1.0);
        visit(b, a.start + a.length * a.along, world.settings.thick, 1.0);
        visit(a, b.start, world.settings.thick, -1.0);
        visit(a, b.start + b.length * b.along, world.settings.thick, -1.0);
    }
}

/// Geometry of a point of kind K were its bodies where i and j say (of a wall j is not looked at); `feature` comes back
/// as the edge faced.
template <PointKind K>
inline ContactGeometry contact_geometry(const World& world, const ContactPoint& point, const BodyState& i,
                                        const BodyState& j, std::uint32_t& feature) {
    if constexpr (K == PointKind::circle_circle) {
        return detail::circles_geometry(j.x - i.x, j.y - i.y, i.shape[0], j.shape[0]);
    } else if constexpr (K == PointKind::element_element) {
        const Element& a = world.bodies.elements[point.element_i];
        const Element& b = world.bodies.elements[point.feature_j];
        const Vec2 oi = turned(i, a), oj = turned(j, b);
        ContactGeometry g =
            detail::circles_geometry((j.x - i.x) + (oj.x - oi.x), (j.y - i.y) + (oj.y - oi.y), a.radius, b.radius);
        g.aix += oi.x;
        g.aiy += oi.y;
        g.ajx += oj.x;
        g.ajy += oj.y;
        return g;
    } else if constexpr (K == PointKind::element_outline) {
        const Element& a = world.bodies.elements[point.element_i];
        const Vec2 oi = turned(i, a);
        const double wx = (i.x - j.x) + oi.x, wy = (i.y - j.y) + oi.y;
        const double cosine = j.shape[0], sine = j.shape[1];
        const OutlineFacing facing = face_outline(world, world.bodies.info[point.body_j], point.feature_j,
                                                  cosine * wx + sine * wy, cosine * wy - sine * wx);
        feature = facing.edge;
        ContactGeometry g;
        g.overlap = a.radius + a.target_reach - facing.distance;
        g.nx = -(cosine * facing.gx - sine * facing.gy);
        g.ny = -(sine * facing.gx + cosine * facing.gy);
        const double lift = a.radius - 0.5 * g.overlap;
        g.aix = oi.x + lift * g.nx;
        g.aiy = oi.y + lift * g.ny;
        g.ajx = wx + lift * g.nx;
        g.ajy = wy + lift * g.ny;
        return g;
    } else if constexpr (by_guide(K)) {
        DiscResultant resultant;
        const auto visit = [&](auto&& add) { visit_discs<K>(world, point, i, j, add); };
        visit([&](const Bar& bar, Vec2 centre, double radius, double sense) {
            resultant.add(bar, centre, radius, sense);
        });
        const DiscResultant::Contact contact =
            resultant.contact(world.settings.segment_law == SegmentLaw::demseg_mean, visit);
        return {contact.overlap, contact.normal.x,           contact.normal.y,          contact.at.x,
                contact.at.y,    contact.at.x - (j.x - i.x), contact.at.y - (j.y - i.y)};
    } else {
        const Element& a = world.bodies.elements[point.element_i];
        const Vec2 oi = turned(i, a);
        const double radius = point.feature_j == 1 ? 0.0 : a.radius;
        const Domain& domain = world.settings.domain;
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

/// The same where the bodies are.
template <PointKind K>
inline ContactGeometry contact_geometry(const World& world, const ContactPoint& point, std::uint32_t& feature) {
    const BodyState& i = world.bodies.state[point.body_i];
    return contact_geometry<K>(world, point, i, K == PointKind::element_wall ? i : world.bodies.state[point.body_j],
                               feature);
}

/// Only the overlap of it, m.
template <PointKind K>
inline double overlap_at(const World& world, const ContactPoint& point) {
    std::uint32_t feature = point.feature_j;
    return contact_geometry<K>(world, point, feature).overlap;
}

/// Calls visit.operator()<K>(begin, end) with the range of points of each kind K. @param kind_begin as of a world
template <class Visit>
inline void visit_kinds(const std::array<PointIndex, point_kinds + 1>& kind_begin, Visit&& visit) {
    const auto of_kind = [&]<PointKind K>() {
        constexpr auto number = static_cast<std::size_t>(K);
        visit.template operator()<K>(kind_begin[number], kind_begin[number + 1]);
    };
    of_kind.template operator()<PointKind::circle_circle>();
    of_kind.template operator()<PointKind::element_element>();
    of_kind.template operator()<PointKind::element_outline>();
    of_kind.template operator()<PointKind::disc_segment>();
    of_kind.template operator()<PointKind::segment_segment>();
    of_kind.template operator()<PointKind::element_wall>();
    static_assert(point_kinds == 6);
}

}  // namespace crackle
