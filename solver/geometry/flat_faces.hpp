// SPDX-License-Identifier: GPL-3.0-or-later
// Flat faces of circles along a trace, so that a joint between circles is as smooth as its trace.
//
// Each side of a straight part of a trace is divided among the circles on that side by their power diagram. A point p
// on it belongs to the circle with the smallest |p - x|² - r². The circle's face is its section of the trace; its
// centre lies at a height h above the face. The faces on one side cover the trace exactly once and are flush with those
// on the other side. Circles on the side that do not border on the trace also have a face, as wide as the circle and at
// a height of at most its radius. It carries load only once the circle reaches the joint. A face moves with the
// circle's centre and does not rotate.
//
// Two circles on opposite sides of a straight part touch only through these faces. With n the normal of the part from i
// to j, t the unit vector along it, x the centres, and [a, b] the extent of the faces along t:
//
//     δ = h_i + h_j - (x_j - x_i)·n         overlap: 0 at the initial height, whichever two faces meet
//     λ = |[a_i, b_i] ∩ [a_j, b_j]|         lap (shared length), m; the stiffness is λ times that of 1 m
//     at ½(x_i + x_j)                       where the force acts on both
//
// The force of a pair therefore begins and ends without a jump as the circles slide past each other, and they never
// interlock. The force also rotates both circles. The overlap at which it is zero (Points::bond_overlap) therefore
// follows the closure caused by their rotation, at the rate ½ (x_j - x_i)·t (ω_i + ω_j). Source: solver/MODEL.md 5.4.
// Tested by tests/solver/geometry/flat_faces_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "solver/geometry/point_geometry.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// Geometry of one contact point between flat faces, or of several points in lanes.
template <class Number>
struct FlatFaceGeometry : PointGeometry<Number> {
    Number apart;   // m, gap between the faces along the trace; negative if they share a length
    Number closed;  // m, δ from the heights alone; if the faces share no length, `overlap` is at most -apart
    Number offset;  // m, (x_j - x_i)·t, where t is the normal turned by +90 degrees
    /// Lap, m: length along the trace that the two faces share, or 0.
    CRACKLE_INLINE Number lap() const { return select(apart < 0.0, -apart, Number{}); }
};
using FlatFaceContact = FlatFaceGeometry<double>;

/// Ends and height of a face, as in FlatFace.
template <class Number>
struct FaceNumbers {
    Number from, to, height;
};

/// Contact geometry of two faces. @param a, b faces of bodies i and j on opposite sides of one straight part of a trace
/// @param along_x, along_y unit vector along the part
/// @param sense sense_of() for face a @param dx, dy position of j relative to i, m
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

/// 1 if the face's body lies to the right of its trace, otherwise -1.
inline double sense_of(const FlatFace& face) { return (face.side & 1) != 0 ? 1.0 : -1.0; }

/// Contact geometry of two faces for the given states of their bodies.
inline FlatFaceContact flat_face_contact(const FlatFace& a, const FlatFace& b, const BodyState& i, const BodyState& j) {
    return flat_face_contact<double>({a.from, a.to, a.height}, {b.from, b.to, b.height}, a.along_x, a.along_y,
                                     sense_of(a), j.x - i.x, j.y - i.y);
}

/// Geometry of a point of the kind face_face.
inline FlatFaceContact flat_face_contact(const BodyView& bodies, const ContactPoint& point) {
    return flat_face_contact(bodies.flat_faces[point.element_i], bodies.flat_faces[point.feature_j],
                             bodies.state[point.body_i], bodies.state[point.body_j]);
}

/// Section of a straight trace that is assigned to a circle: positions of its ends, m from the start of the trace.
struct TraceShare {
    double from, to;
};

/// A circle beside a straight trace, m: projection of its centre on the trace, distance of its centre from the trace,
/// and its radius.
struct CircleAtTrace {
    double foot, distance, radius;
};

/// Divides a trace among the circles on one side of it by their power diagram. The entry of a circle that gets no
/// section is empty.
/// @param length length of the trace, m
std::vector<std::optional<TraceShare>> share_trace(std::span<const CircleAtTrace> circles, double length);

/// Creates the flat faces of the circles along the traces of joints, from the current positions. @param pieces straight
/// parts of all traces
void lay_flat_faces(World& world, std::span<const TracePiece> pieces);

}  // namespace crackle
