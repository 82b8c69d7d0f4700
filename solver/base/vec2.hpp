// SPDX-License-Identifier: GPL-3.0-or-later
// Plane vectors. Axes: x to the right, y up, angles counter-clockwise in rad.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <cmath>

namespace crackle {

struct Vec2 {
    double x = 0.0;
    double y = 0.0;

    friend bool operator==(const Vec2&, const Vec2&) = default;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
    }
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline Vec2 operator*(Vec2 a, double s) { return s * a; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z component of a × b: positive when b lies counter-clockwise of a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// a turned by +90 degrees.
inline Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }

}  // namespace crackle
