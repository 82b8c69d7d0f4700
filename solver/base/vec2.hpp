// SPDX-License-Identifier: GPL-3.0-or-later
// Plane vectors. Axes: x to the right, y upwards; angles counter-clockwise, in rad.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cmath>

#include "solver/base/fields.hpp"

namespace crackle {

/// A vector in the plane. Its components have the unit of the quantity that the vector represents.
struct Vec2 {
    double x = 0.0;
    double y = 0.0;

    friend bool operator==(const Vec2&, const Vec2&) = default;

    CRACKLE_FIELDS(x, y);
};

/// Sum.
inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
/// Difference.
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
/// Negative of a vector.
inline Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
/// Product of a number and a vector.
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
/// Product of a number and a vector.
inline Vec2 operator*(Vec2 a, double s) { return s * a; }
/// Scalar product.
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z component of a × b; positive if b is counter-clockwise from a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// Length.
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// The vector a rotated by +90 degrees.
inline Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }

}  // namespace crackle
