// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry of a contact point, and the forces and moments that it exerts on the two bodies.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <limits>

#include "solver/base/lanes.hpp"

namespace crackle {

/// Geometry of one contact point, or of several points in lanes.
template <class Number>
struct PointGeometry {
    Number overlap;   // m
    Number nx, ny;    // unit normal, from i to j
    Number aix, aiy;  // m, vector from i's centroid to the contact position
    Number ajx, ajy;  // m, vector from j's centroid to the contact position
};
using ContactGeometry = PointGeometry<double>;

/// Squared distance s below which two points count as coincident, m2. Above it, 1/√s equals √s·(1/s) to round-off, so
/// the square root and the division can be computed in parallel.
inline constexpr double least_squared_distance = std::numeric_limits<double>::min();

/// Force of a contact point on body i, N (j receives the opposite force), and its moments about both centroids, N m.
template <class Number>
struct ForceOnBodies {
    Number fx, fy;
    Number torque_i, torque_j;
};

/// Converts the force of a contact point to forces and moments on the bodies. @param normal force that pushes i and j
/// apart, N @param shear force on i along the normal turned by +90 degrees, N
template <class Number>
CRACKLE_INLINE ForceOnBodies<Number> force_on_bodies(const PointGeometry<Number>& g, const Number& normal,
                                                     const Number& shear) {
    const Number fx = -normal * g.nx - shear * g.ny, fy = -normal * g.ny + shear * g.nx;
    return {fx, fy, g.aix * fy - g.aiy * fx, g.ajy * fx - g.ajx * fy};
}

}  // namespace crackle
