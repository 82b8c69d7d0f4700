// SPDX-License-Identifier: GPL-3.0-or-later
// How i moves against j at the contact position: v_i + ω_i × a_i - v_j - ω_j × a_j along the normal and the tangent.
//
// Where an arm is not along the normal, ω × a at the end of the drift misses the chord of its turn, ½ω²Δt·a, in the
// slip. Left out, a bonded specimen that turns as a whole would collect shear, first order in Δt.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include "solver/geometry/circle_geometry.hpp"
#include "solver/geometry/point_geometry.hpp"

namespace crackle {

template <class Number>
struct RelativeMotion {
    Number closing, slipping;  // m/s, along the normal and the tangent
};

/// How two bodies move: velocity of i against j, m/s, and both spins, rad/s.
template <class Number>
struct PairMotion {
    Number vx, vy;
    Number spin_i, spin_j;
};

/// Slip rate of an arm by the chord of its turn, m/s. @param half half of the drift, s
template <class Number>
CRACKLE_INLINE Number chord(double half, const Number& spin, const Number& arm_x, const Number& arm_y,
                            const PointGeometry<Number>& g) {
    return half * spin * spin * (arm_y * g.nx - arm_x * g.ny);
}

/// Of single circles, whose arms are along the normal.
template <class Number>
CRACKLE_INLINE RelativeMotion<Number> relative_motion(const CircleContact<Number>& c, const PairMotion<Number>& m) {
    return {m.vx * c.nx + m.vy * c.ny, (m.vy * c.nx - m.vx * c.ny) + (m.spin_i * c.arm_i + m.spin_j * c.arm_j)};
}

/// @param drift s, that led to these positions
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

/// Of a body against a wall, which stays. @param m of which spin_j is nothing
template <class Number>
CRACKLE_INLINE RelativeMotion<Number> motion_against_wall(const PointGeometry<Number>& g, const PairMotion<Number>& m,
                                                          double drift) {
    const Number rx = m.vx - m.spin_i * g.aiy, ry = m.vy + m.spin_i * g.aix;
    return {rx * g.nx + ry * g.ny, ry * g.nx - rx * g.ny + chord(0.5 * drift, m.spin_i, g.aix, g.aiy, g)};
}

}  // namespace crackle
