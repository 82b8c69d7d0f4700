// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of a point from an outline: edges and corners of its convex pieces and open segments.
//
// A point lies `across` in front of the line of an edge, and `over` beyond one of the edge's ends (negative at the
// start; 0: before the edge itself). In front of the edge its distance is `across`, the gradient the edge's normal;
// beyond an end it is that from the corner. Both are needed of one point and of several in lanes.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "solver/geometry/point_geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// An edge as a Number knows it: start, unit direction, length and the cones of its corners, as Edge has them.
template <class Number>
struct EdgeNumbers {
    Number x, y, tx, ty, length, cone_before, cone_beyond;
};

/// Where a point lies before an edge.
template <class Number>
struct BeforeEdge {
    Number across, along, over;    // m; along from the edge's start
    Condition<Number> is_closest;  // of a convex outline: the edge, or its corner where over != 0
};

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

/// Distance from an edge or one of its ends, and its unit gradient in the frame of the edge's body.
template <class Number>
struct OutlineDistance {
    Number distance, gx, gy;
};

/// @param at_corner the end is what is closest, else the edge @param tx, ty direction of the edge
template <class Number>
CRACKLE_INLINE OutlineDistance<Number> outline_distance(const Condition<Number>& at_corner, const Number& over,
                                                        const Number& across, const Number& tx, const Number& ty) {
    if constexpr (std::is_same_v<Number, double>)
        if (!at_corner) return {across, ty, -tx};
    const Number squared = over * over + across * across;
    const Number to_corner = root(squared), inverse = to_corner * (1.0 / squared);
    // On the corner itself any direction of its normal cone will do; the edge's normal is one.
    const Condition<Number> turned = at_corner & (squared >= least_squared_distance);
    const Number along = over * inverse, out = across * inverse;
    return {select(at_corner, to_corner, across), select(turned, along * tx + out * ty, ty),
            select(turned, along * ty - out * tx, -tx)};
}

/// What an element knows of the outline it faces.
template <class Number>
struct FacingElement {
    Number ox, oy;        // m, its centre from i's centroid
    Number wx, wy;        // m, from j's
    Number radius;        // m
    Number cover;         // m, distance at which the overlap begins
    Number cosine, sine;  // of j
};

/// Contact of an element of i with the outline of j.
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

/// Closest feature of an outline to a point of its body frame.
struct OutlineFacing : OutlineDistance<double> {
    std::uint32_t edge;  // faced, into Bodies::edges
};

namespace detail {

/// @param at_corner the end is what is closest, else the edge
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

/// Signed distance to a convex closed piece by looking at every edge.
inline OutlineFacing face_every_edge(const Edge* edges, const Piece& piece, double px, double py) {
    OutlineFacing inside = far_away(-std::numeric_limits<double>::infinity());
    OutlineFacing outside = far_away(std::numeric_limits<double>::infinity());
    const std::uint32_t end = piece.first_edge + piece.edge_count;
    for (std::uint32_t e = piece.first_edge; e < end; ++e) {
        const BeforeEdge<double> p = before_edge_of(edges[e], px, py);
        if (p.across > inside.distance) inside = facing_of(false, 0.0, p.across, edges[e], e);
        if (p.across <= 0.0) continue;  // the closest edge of an outside point is one that sees it
        const OutlineFacing candidate = facing_of(p.over != 0.0, p.over, p.across, edges[e], e);
        if (candidate.distance < outside.distance) outside = candidate;
    }
    return inside.distance <= 0.0 ? inside : outside;
}

/// Signed distance to a convex closed piece, starting from the edge faced last. The normal strips of the edges and the
/// cones of the corners partition the outside of a convex outline, so a point found in one needs no further search.
/// A corner's place is taken from the edge it faces: the two that meet there agree to rounding.
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

/// Closest feature of a body's outline (minimum over its convex pieces and segments); `hint` is the edge faced last.
inline OutlineFacing face_outline(const World& world, const BodyInfo& body, std::uint32_t hint, double px, double py) {
    const Piece* pieces = world.bodies.pieces.data() + body.first_piece;
    const Edge* edges = world.bodies.edges.data();
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
