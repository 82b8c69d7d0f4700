// SPDX-License-Identifier: GPL-3.0-or-later
// Velocity of i relative to j at the contact position: v_i + ω_i × a_i - v_j - ω_j × a_j along the normal and the
// tangent.
//
// The drift is the part of a step that moves the bodies. If an arm a is not along the normal, ω × a at the end of the
// drift differs from the mean slip rate over the drift. The difference is ½ω²Δt·a, since the arm's end moved along a
// chord. Without this chord term, a bonded specimen in rigid rotation would accumulate shear forces of first order in
// Δt. Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include "solver/geometry/circle_geometry.hpp"
#include "solver/geometry/point_geometry.hpp"

namespace crackle {

/// Relative velocity of the two sides of a contact point.
template <class Number>
struct RelativeMotion {
    Number closing, slipping;  // m/s, along the normal and the tangent
};

/// Motion of two bodies: velocity of i relative to j, m/s, and the angular velocities of both, rad/s.
template <class Number>
struct PairMotion {
    Number vx, vy;
    Number spin_i, spin_j;
};

/// Part of the slip rate due to the chord along which an arm's end moves, m/s. @param half half the drift time, s
template <class Number>
CRACKLE_INLINE Number chord(double half, const Number& spin, const Number& arm_x, const Number& arm_y,
                            const PointGeometry<Number>& g) {
    return half * spin * spin * (arm_y * g.nx - arm_x * g.ny);
}

/// Relative motion of two single circles, whose arms are along the normal.
template <class Number>
CRACKLE_INLINE RelativeMotion<Number> relative_motion(const CircleContact<Number>& c, const PairMotion<Number>& m) {
    return {m.vx * c.nx + m.vy * c.ny, (m.vy * c.nx - m.vx * c.ny) + (m.spin_i * c.arm_i + m.spin_j * c.arm_j)};
}

/// Relative motion of two bodies at a contact point. @param drift duration of the drift that led to the current
/// positions, s
template <class Number>
CRACKLE_INLINE RelativeMotion<Number> relative_motion(const PointGeometry<Number>& g, const PairMotion<Number>& m,
                                                      double drift) {
    const Number rx = m.vx - (m.spin_i * g.aiy - m.spin_j * g.ajy);
    const Number ry = m.vy + (m.spin_i * g.aix - m.spin_j * g.ajx);
    RelativeMotion<Number> motion;
    motion.closing = rx * g.nx + ry * g.ny;
    motion.slipping = ry * g.nx - rx * g.ny;
    motion.slipping += chord(0.5 * drift, m.spin_i, g.aix, g.aiy, g);
    motion.slipping -= chord(0.5 * drift, m.spin_j, g.ajx, g.ajy, g);
    return motion;
}

/// Motion of a body relative to a fixed wall. @param m motion of the body; `spin_j` is not used
template <class Number>
CRACKLE_INLINE RelativeMotion<Number> motion_against_wall(const PointGeometry<Number>& g, const PairMotion<Number>& m,
                                                          double drift) {
    const Number rx = m.vx - m.spin_i * g.aiy, ry = m.vy + m.spin_i * g.aix;
    return {rx * g.nx + ry * g.ny, ry * g.nx - rx * g.ny + chord(0.5 * drift, m.spin_i, g.aix, g.aiy, g)};
}

}  // namespace crackle
