// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of a point from an outline, which consists of convex pieces and open segments.
//
// Relative to an edge, `across` is the distance in front of the edge's line, and `over` the distance beyond one of its
// ends (negative at the start, 0 between the ends). Between the ends, the distance is `across` and its gradient is the
// edge's normal. Beyond an end, it is the distance from the corner. The code handles one point, or several in lanes.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "solver/geometry/point_geometry.hpp"
#include "solver/world/bodies.hpp"

namespace crackle {

/// An edge as values of type Number: start, unit direction, length, and the cones of its corners (Edge::cone).
template <class Number>
struct EdgeNumbers {
    Number x, y, tx, ty, length, cone_before, cone_beyond;
};

/// Position of a point relative to an edge.
template <class Number>
struct BeforeEdge {
    Number across, along, over;  // m; `along` is measured from the edge's start
    Condition<Number>
        is_closest;  // whether this edge (or its corner, if over != 0) is the closest feature of a convex outline
};

/// Position of a point relative to an edge. @param px, py coordinates of the point in the frame in which the edge is
/// given, m
template <class Number>
CRACKLE_INLINE BeforeEdge<Number> before_edge(const EdgeNumbers<Number>& edge, const Number& px, const Number& py) {
    const Number dx = px - edge.x, dy = py - edge.y;
    const Number across = dx * edge.ty - dy * edge.tx, along = dx * edge.tx + dy * edge.ty;
    const Condition<Number> before = along < 0.0;
    const Number over = select(before, along, select(along > edge.length, along - edge.length, Number{}));
    const Number cone = select(before, edge.cone_before, edge.cone_beyond);
    const Condition<Number> is_closest = (across >= 0.0) & (across + over * cone >= 0.0);
    return {across, along, over, is_closest};
}

/// Distance from an edge or its end, and the unit gradient of the distance in the body frame.
template <class Number>
struct OutlineDistance {
    Number distance, gx, gy;
};

/// Distance and its gradient at a given position relative to an edge. @param at_corner whether an end of the edge is
/// the closest point @param tx, ty unit direction of the edge
template <class Number>
CRACKLE_INLINE OutlineDistance<Number> outline_distance(const Condition<Number>& at_corner, const Number& over,
                                                        const Number& across, const Number& tx, const Number& ty) {
    if constexpr (std::is_same_v<Number, double>)
        if (!at_corner) return {across, ty, -tx};
    const Number squared = over * over + across * across;
    const Number to_corner = root(squared), inverse = to_corner * (1.0 / squared);
    // For a point at the corner itself, any direction in its normal cone is valid; the edge's normal is used.
    const Condition<Number> turned = at_corner & (squared >= least_squared_distance);
    const Number along = over * inverse, out = across * inverse;
    return {select(at_corner, to_corner, across), select(turned, along * tx + out * ty, ty),
            select(turned, along * ty - out * tx, -tx)};
}

/// Position of an element relative to the outline it may touch.
template <class Number>
struct FacingElement {
    Number ox, oy;        // m, position of the element's centre relative to i's centroid
    Number wx, wy;        // m, position of the element's centre relative to j's centroid
    Number radius;        // m
    Number cover;         // m, distance from the outline at which the overlap is zero
    Number cosine, sine;  // cosine and sine of the rotation of body j
};

/// Contact of an element of body i with the outline of body j.
template <class Number>
CRACKLE_INLINE PointGeometry<Number> outline_contact(const FacingElement<Number>& e,
                                                     const OutlineDistance<Number>& facing) {
    PointGeometry<Number> g;
    g.overlap = e.cover - facing.distance;
    g.nx = -(e.cosine * facing.gx - e.sine * facing.gy);
    g.ny = -(e.sine * facing.gx + e.cosine * facing.gy);
    const Number lift = e.radius - 0.5 * g.overlap;
    const Number lift_x = lift * g.nx, lift_y = lift * g.ny;
    g.aix = e.ox + lift_x;
    g.aiy = e.oy + lift_y;
    g.ajx = e.wx + lift_x;
    g.ajy = e.wy + lift_y;
    return g;
}

/// Feature of an outline that is closest to a point, in the body frame.
struct OutlineFacing : OutlineDistance<double> {
    std::uint32_t edge;  // the edge that the point faces, index into Bodies::edges
};

namespace detail {

/// Closest feature, from the position relative to an edge. @param at_corner whether the edge's end is the closest point
inline OutlineFacing facing_of(bool at_corner, double over, double across, const Edge& edge, std::uint32_t index) {
    return {outline_distance(at_corner, over, across, edge.tx, edge.ty), index};
}

inline BeforeEdge<double> before_edge_of(const Edge& edge, double px, double py) {
    return before_edge<double>({edge.x, edge.y, edge.tx, edge.ty, edge.length, edge.cone[0], edge.cone[1]}, px, py);
}

inline OutlineFacing far_away(double distance) { return {{distance, 0.0, 0.0}, 0}; }

/// Unsigned distance to one open segment.
inline OutlineFacing face_segment(const Edge& edge, std::uint32_t index, double px, double py) {
    const BeforeEdge<double> p = before_edge_of(edge, px, py);
    if (p.along <= 0.0) return facing_of(true, p.along, p.across, edge, index);
    if (p.along >= edge.length) return facing_of(true, p.along - edge.length, p.across, edge, index);
    return p.across >= 0.0 ? facing_of(false, 0.0, p.across, edge, index)
                           : OutlineFacing{{-p.across, -edge.ty, edge.tx}, index};
}

/// Signed distance to a convex closed piece, found by testing every edge.
inline OutlineFacing face_every_edge(const Edge* edges, const Piece& piece, double px, double py) {
    OutlineFacing inside = far_away(-std::numeric_limits<double>::infinity());
    OutlineFacing outside = far_away(std::numeric_limits<double>::infinity());
    const std::uint32_t end = piece.first_edge + piece.edge_count;
    for (std::uint32_t e = piece.first_edge; e < end; ++e) {
        const BeforeEdge<double> p = before_edge_of(edges[e], px, py);
        if (p.across > inside.distance) inside = facing_of(false, 0.0, p.across, edges[e], e);
        if (p.across <= 0.0) continue;  // only an edge that the point lies in front of can be the closest
        const OutlineFacing candidate = facing_of(p.over != 0.0, p.over, p.across, edges[e], e);
        if (candidate.distance < outside.distance) outside = candidate;
    }
    return inside.distance <= 0.0 ? inside : outside;
}

/// Signed distance to a convex closed piece, starting from the edge found by the previous call. The strips in front of
/// the edges and the cones at the corners partition the outside of a convex outline. The search therefore ends at the
/// first region that contains the point. A corner's position is computed from the edge that is being tested; the two
/// edges that meet at the corner agree to round-off.
inline OutlineFacing face_convex(const Edge* edges, const Piece& piece, std::uint32_t hint, double px, double py) {
    const std::uint32_t first = piece.first_edge, last = first + piece.edge_count - 1;
    std::uint32_t e = hint >= first && hint <= last ? hint : first;
    for (std::uint32_t tries = 0; tries < piece.edge_count; ++tries) {
        const BeforeEdge<double> p = before_edge_of(edges[e], px, py);
        if (!(p.across >= 0.0)) break;
        if (p.is_closest) return facing_of(p.over != 0.0, p.over, p.across, edges[e], e);
        e = p.over < 0.0 ? (e == first ? last : e - 1) : (e == last ? first : e + 1);
    }
    return face_every_edge(edges, piece, px, py);
}

}  // namespace detail

/// Closest feature of a body's outline: the minimum over its convex pieces and segments. @param body BodyShape or
/// BodyInfo @param hint edge faced last @param px, py the point in the body frame, m
template <class Outlined>
inline OutlineFacing face_outline(const BodyView& bodies, const Outlined& body, std::uint32_t hint, double px,
                                  double py) {
    const Piece* pieces = bodies.pieces + body.first_piece;
    const Edge* edges = bodies.edges;
    if (body.piece_count == 1 && pieces[0].closed) return detail::face_convex(edges, pieces[0], hint, px, py);
    OutlineFacing best = detail::far_away(std::numeric_limits<double>::infinity());
    for (std::uint32_t p = 0; p < body.piece_count; ++p) {
        const OutlineFacing facing =
            pieces[p].closed ? detail::face_every_edge(edges, pieces[p], px, py)
                             : detail::face_segment(edges[pieces[p].first_edge], pieces[p].first_edge, px, py);
        if (facing.distance < best.distance) best = facing;
    }
    return best;
}

}  // namespace crackle
