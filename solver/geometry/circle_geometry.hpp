// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of two circles: overlap δ = r_i + r_j - d, where d is the distance between their centres. The normal points
// from centre to centre; the contact position lies between the centres, midway between the two surfaces.
// Tested by tests/solver/geometry/geometry_test.cpp.
#pragma once

#include "solver/geometry/point_geometry.hpp"

namespace crackle {

/// Contact of two circles.
template <class Number>
struct CircleContact {
    Number overlap;  // m
    Number nx, ny;   // unit normal, from i to j
    // m, distances of the contact position from the centre of i (along the normal) and of j (against the normal).
    Number arm_i, arm_j;
};

/// Geometry of two circles. @param dx, dy position of the second relative to the first, m
template <class Number>
CRACKLE_INLINE CircleContact<Number> circle_contact(const Number& dx, const Number& dy, const Number& radius_i,
                                                    const Number& radius_j) {
    const Number squared = dx * dx + dy * dy, distance = root(squared), inverse = distance * (1.0 / squared);
    const Condition<Number> apart = squared >= least_squared_distance;
    CircleContact<Number> c;
    c.overlap = radius_i + radius_j - distance;
    // Coincident centres have no normal, so the x axis is used.
    c.nx = select(apart, dx * inverse, all_of<Number>(1.0));
    c.ny = select(apart, dy * inverse, Number{});
    c.arm_i = radius_i - 0.5 * c.overlap;
    c.arm_j = radius_j - 0.5 * c.overlap;
    return c;
}

/// Converts the arms from distances to vectors from the circles' centres.
template <class Number>
CRACKLE_INLINE PointGeometry<Number> with_arms(const CircleContact<Number>& c) {
    return {c.overlap, c.nx, c.ny, c.arm_i * c.nx, c.arm_i * c.ny, -c.arm_j * c.nx, -c.arm_j * c.ny};
}

/// Forces on two single-circle bodies, whose centroids are the circles' centres.
template <class Number>
CRACKLE_INLINE ForceOnBodies<Number> force_on_bodies(const CircleContact<Number>& c, const Number& normal,
                                                     const Number& shear) {
    return {-normal * c.nx - shear * c.ny, -normal * c.ny + shear * c.nx, c.arm_i * shear, c.arm_j * shear};
}

}  // namespace crackle
