// SPDX-License-Identifier: GPL-3.0-or-later
// Flat faces of circles at a trace: a joint among circles is as smooth as its trace, not as the circles are round.
//
// Each side of a straight part of a trace is shared among the circles of that side by their power diagram: a point p
// on it is of the circle with the least |p - x|² - r². The part of the trace that is a circle's is its face, at the
// height h of its centre above it. The faces of a side cover the trace once, and lie flush with those of the other.
// Circles of the side that are not at the trace have a face, too, as wide as they are and at the height of their
// radius: it comes to bear once they lie at the joint. A face moves with the circle's centre and does not turn.
//
// Faces of two circles on opposite sides of a part are the one contact that these have. With n the part's normal from
// i to j, t along it, x the centres, [a, b] the faces along t:
//
//     δ = h_i + h_j - (x_j - x_i)·n         overlap: 0 where the faces lie as at the start, whichever two meet
//     λ = |[a_i, b_i] ∩ [a_j, b_j]|         lap, m; its stiffness is that of a metre times λ
//     at ½(x_i + x_j)                       where its force acts on both
//
// so that a pair comes to bear, and lets go, without a jump as it slides past, and never interlocks. A force there
// turns both circles: δ without force, Points::bond_overlap, follows by what their turning closes it,
// ½ (x_j - x_i)·t (ω_i + ω_j) a second. Source: solver/MODEL.md 5.4.
// Tested by tests/solver/geometry/flat_faces_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "solver/geometry/point_geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Of one point, or of several in lanes.
template <class Number>
struct FlatFaceGeometry : PointGeometry<Number> {
    Number apart;   // m, of the faces along the trace; < 0 where they lap
    Number closed;  // m, δ whether they lap or not: overlap is `-apart` where they do not, if that is less
    Number offset;  // m, (x_j - x_i)·t, t the normal turned by +90 degrees
    CRACKLE_INLINE Number lap() const { return select(apart < 0.0, -apart, Number{}); }
};
using FlatFaceContact = FlatFaceGeometry<double>;

/// As in FlatFace.
template <class Number>
struct FaceNumbers {
    Number from, to, height;
};

/// @param a, b faces of bodies i and j on opposite sides of one part of a trace @param along_x, along_y its direction
/// @param sense sense_of() the first @param dx, dy of j from i, m
template <class Number>
CRACKLE_INLINE FlatFaceGeometry<Number> flat_face_contact(const FaceNumbers<Number>& a, const FaceNumbers<Number>& b,
                                                          const Number& along_x, const Number& along_y,
                                                          const Number& sense, const Number& dx, const Number& dy) {
    const Number along = dx * along_x + dy * along_y, from = along + b.from, to = along + b.to;
    FlatFaceGeometry<Number> c{};
    c.nx = -sense * along_y;
    c.ny = sense * along_x;
    c.closed = a.height + b.height - (dx * c.nx + dy * c.ny);
    c.apart = select(a.from < from, from, a.from) - select(to < a.to, to, a.to);
    c.overlap = select((c.apart < 0.0) | (c.closed <= -c.apart), c.closed, -c.apart);
    c.offset = -sense * along;
    c.aix = 0.5 * dx;
    c.aiy = 0.5 * dy;
    c.ajx = -0.5 * dx;
    c.ajy = -0.5 * dy;
    return c;
}

/// Of the body i of a point: 1 where it lies on the right of its trace, else -1.
inline double sense_of(const FlatFace& face) { return (face.side & 1) != 0 ? 1.0 : -1.0; }

inline FlatFaceContact flat_face_contact(const FlatFace& a, const FlatFace& b, const BodyState& i, const BodyState& j) {
    return flat_face_contact<double>({a.from, a.to, a.height}, {b.from, b.to, b.height}, a.along_x, a.along_y,
                                     sense_of(a), j.x - i.x, j.y - i.y);
}

inline FlatFaceContact flat_face_contact(const World& world, const ContactPoint& point) {
    return flat_face_contact(world.bodies.flat_faces[point.element_i], world.bodies.flat_faces[point.feature_j],
                             world.bodies.state[point.body_i], world.bodies.state[point.body_j]);
}

/// The part of a straight trace that a circle has, m from its begin.
struct TraceShare {
    double from, to;
};

/// A circle beside a straight trace: its foot along that and its distance, m.
struct CircleAtTrace {
    double foot, distance, radius;
};

/// How circles on one side of a trace share it: by their power diagram; nothing of one that has no part of it.
/// @param length of the trace, m
std::vector<std::optional<TraceShare>> share_trace(std::span<const CircleAtTrace> circles, double length);

/// Gives the circles at the traces of joints their faces, as they lie. @param pieces of all traces
void lay_flat_faces(World& world, std::span<const TracePiece> pieces);

}  // namespace crackle
