// SPDX-License-Identifier: GPL-3.0-or-later
// Where two bodies meet, and what the forces there do to them.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include <limits>

#include "solver/base/lanes.hpp"

namespace crackle {

/// Of one contact point, or of several in lanes.
template <class Number>
struct PointGeometry {
    Number overlap;   // m
    Number nx, ny;    // unit normal, from i to j
    Number aix, aiy;  // m, arm from i's centroid to the contact position
    Number ajx, ajy;  // m, from j's
};
using ContactGeometry = PointGeometry<double>;

/// m2; closer points are taken to coincide. Above, √s/s is 1/√s to rounding; the root and the division need not wait
/// for each other.
inline constexpr double least_squared_distance = std::numeric_limits<double>::min();

/// Force of a point on i (j gets the opposite), N, and its moments about both centroids, N m.
template <class Number>
struct ForceOnBodies {
    Number fx, fy;
    Number torque_i, torque_j;
};

/// @param normal pushes i away from j @param shear on i along the normal turned by +90 degrees
template <class Number>
CRACKLE_INLINE ForceOnBodies<Number> force_on_bodies(const PointGeometry<Number>& g, const Number& normal,
                                                     const Number& shear) {
    const Number fx = -normal * g.nx - shear * g.ny, fy = -normal * g.ny + shear * g.nx;
    return {fx, fy, g.aix * fy - g.aiy * fx, g.ajy * fx - g.ajx * fy};
}

}  // namespace crackle
