// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of a face and its forces on the two bodies (faces.hpp).
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include <cmath>

#include "solver/faces/faces.hpp"

namespace crackle {

/// A vector of a body's frame in world axes.
inline Vec2 turned_with(const BodyState& body, Vec2 v) {
    return {body.shape[0] * v.x - body.shape[1] * v.y, body.shape[1] * v.x + body.shape[0] * v.y};
}

/// Motion of a face at the current positions.
inline FaceMotion motion_of(const FacePlace& place, const BodyState& i, const BodyState& j) {
    // The sum of the two turned normals bisects their angle.
    const Vec2 sum = turned_with(i, place.normal_i) + turned_with(j, place.normal_j);
    const Vec2 normal = (1.0 / norm(sum)) * sum;
    const Vec2 apart = Vec2{j.x - i.x, j.y - i.y} + (turned_with(j, place.arm_j) - turned_with(i, place.arm_i));
    return {normal, dot(apart, normal), dot(apart, perpendicular(normal)), (j.angle - i.angle) - place.rest_turn};
}

/// Rates of the motion of a face, m/s and rad/s.
struct FaceRates {
    double opening, sliding, turn;
};

/// Rates of a face's motion at the current velocities.
inline FaceRates rates_of(const FacePlace& place, const FaceMotion& motion, const BodyState& i, const BodyState& j) {
    const auto velocity = [](const BodyState& body, Vec2 arm) {
        return Vec2{body.vx, body.vy} + body.omega * perpendicular(turned_with(body, arm));
    };
    const Vec2 apart = velocity(j, place.arm_j) - velocity(i, place.arm_i);
    const double spin = 0.5 * (i.omega + j.omega);
    return {dot(apart, motion.normal) + spin * motion.sliding,
            dot(apart, perpendicular(motion.normal)) - spin * motion.opening, j.omega - i.omega};
}

/// Forces of a face on its bodies: on i, and torques on both. They act midway between the two images of the midpoint.
inline PointForce forces_on_bodies(const FacePlace& place, const FaceMotion& motion, const BodyState& i,
                                   const BodyState& j, const FaceForces& f) {
    const Vec2 along = perpendicular(motion.normal);
    const Vec2 force = f.normal * motion.normal + f.shear * along;
    const Vec2 half = 0.5 * (motion.opening * motion.normal + motion.sliding * along);
    return {force.x, force.y, cross(turned_with(i, place.arm_i) + half, force) + f.moment,
            -cross(turned_with(j, place.arm_j) - half, force) - f.moment};
}

/// Elastic forces of an intact face. @param pressure p̄, Pa @param skewing τ, Pa
inline FaceForces intact_forces(const FaceSprings& s, const FaceMotion& m, double pressure, double skewing) {
    return {s.normal * m.opening + s.length * pressure, s.shear * m.sliding + s.length * skewing, s.moment() * m.turn};
}

}  // namespace crackle
