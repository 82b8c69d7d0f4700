// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of a face and its forces on the two bodies (faces.hpp), written once for one face (Number is double) and for
// several (Number is Lanes), with bit-identical results.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/base/lanes.hpp"
#include "solver/world/faces.hpp"

namespace crackle {

/// A vector in the plane, or one vector in each lane.
template <class Number>
struct VecOf {
    Number x, y;
};
template <class Number>
CRACKLE_INLINE VecOf<Number> operator+(const VecOf<Number>& a, const VecOf<Number>& b) {
    return {a.x + b.x, a.y + b.y};
}
template <class Number>
CRACKLE_INLINE VecOf<Number> operator-(const VecOf<Number>& a, const VecOf<Number>& b) {
    return {a.x - b.x, a.y - b.y};
}
template <class Number>
CRACKLE_INLINE VecOf<Number> operator*(const Number& s, const VecOf<Number>& a) {
    return {s * a.x, s * a.y};
}
/// Scalar product.
template <class Number>
CRACKLE_INLINE Number dot(const VecOf<Number>& a, const VecOf<Number>& b) {
    return a.x * b.x + a.y * b.y;
}
/// Component of the vector product normal to the plane.
template <class Number>
CRACKLE_INLINE Number cross(const VecOf<Number>& a, const VecOf<Number>& b) {
    return a.x * b.y - a.y * b.x;
}
/// The vector, turned by +90°.
template <class Number>
CRACKLE_INLINE VecOf<Number> perpendicular(const VecOf<Number>& a) {
    return {-a.y, a.x};
}

/// Position and rotation of a body, from which the motion of its faces is computed.
template <class Number>
struct FaceBody {
    VecOf<Number> place;  // m
    Number cosine, sine;  // cosine and sine of the rotation from the body frame to world axes
    Number angle;         // rad

    /// Converts a vector from the body frame to world axes.
    CRACKLE_INLINE VecOf<Number> turned(const VecOf<Number>& v) const {
        return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
    }
};
/// Velocities of a body.
template <class Number>
struct FaceBodyRates {
    VecOf<Number> velocity;  // m/s
    Number spin;             // rad/s
};
/// Position and rotation of one body.
inline FaceBody<double> face_body(const BodyState& body) {
    return {{body.x, body.y}, body.shape[0], body.shape[1], body.angle};
}
/// Velocities of one body.
inline FaceBodyRates<double> face_body_rates(const BodyState& body) { return {{body.vx, body.vy}, body.omega}; }

/// The values of one FacePlace, or those of several faces in lanes.
template <class Number>
struct PlaceOf {
    VecOf<Number> normal_i, normal_j, arm_i, arm_j;
    Number rest_turn;
};
/// The values of one face.
inline PlaceOf<double> place_of(const FacePlace& place) {
    const auto of = [](Vec2 v) { return VecOf<double>{v.x, v.y}; };
    return {of(place.normal_i), of(place.normal_j), of(place.arm_i), of(place.arm_j), place.rest_turn};
}

/// The values of one BondFaceMotion, or those of several faces in lanes.
template <class Number>
struct MotionOf {
    VecOf<Number> normal;
    Number opening, sliding, turn;
};

/// Motion of a face at the current positions.
template <class Number>
CRACKLE_INLINE MotionOf<Number> motion_of(const PlaceOf<Number>& place, const FaceBody<Number>& i,
                                          const FaceBody<Number>& j) {
    // The sum of the two turned normals bisects their angle.
    const VecOf<Number> sum = i.turned(place.normal_i) + j.turned(place.normal_j);
    const Number inverse = 1.0 / root(dot(sum, sum));
    const VecOf<Number> normal = inverse * sum;
    const VecOf<Number> apart = (j.place - i.place) + (j.turned(place.arm_j) - i.turned(place.arm_i));
    return {normal, dot(apart, normal), dot(apart, perpendicular(normal)), (j.angle - i.angle) - place.rest_turn};
}
/// Converts a vector from a body's frame to world axes.
inline Vec2 turned_by(const BodyState& body, Vec2 v) {
    return {body.shape[0] * v.x - body.shape[1] * v.y, body.shape[1] * v.x + body.shape[0] * v.y};
}

/// Largest relative rotation for which the normal bisects the two turned normals, rad. For larger rotations, only the
/// scalar motion_of() is correct.
inline constexpr double last_bisected_turn = 2.0;

/// Unit normal of a face, turned by the mean of both rotations. It is continuous for any relative rotation, while the
/// sum of the two turned normals a and b changes its sign at half a turn. @param turn relative rotation, rad
inline VecOf<double> mean_normal(const VecOf<double>& a, const VecOf<double>& b, double turn) {
    const double turns = turn / (2.0 * std::numbers::pi);
    const bool opposed = dot(a, b) < -0.5;  // |a + b| would be small; |b - a| is not
    const VecOf<double> across = opposed ? -1.0 * perpendicular(b + -1.0 * a) : a + b;
    const double whole = opposed ? std::floor(turns) : std::nearbyint(turns);
    const double sign = std::fmod(whole, 2.0) == 0.0 ? 1.0 : -1.0;
    return (sign / std::sqrt(dot(across, across))) * across;
}

/// Motion of one face, for any relative rotation.
inline BondFaceMotion motion_of(const FacePlace& place, const BodyState& i, const BodyState& j) {
    const PlaceOf<double> p = place_of(place);
    const FaceBody<double> body_i = face_body(i), body_j = face_body(j);
    MotionOf<double> m = motion_of(p, body_i, body_j);
    if (std::abs(m.turn) > last_bisected_turn) {
        m.normal = mean_normal(body_i.turned(p.normal_i), body_j.turned(p.normal_j), m.turn);
        const VecOf<double> apart = (body_j.place - body_i.place) + (body_j.turned(p.arm_j) - body_i.turned(p.arm_i));
        m.opening = dot(apart, m.normal), m.sliding = dot(apart, perpendicular(m.normal));
    }
    return {{m.normal.x, m.normal.y}, m.opening, m.sliding, m.turn};
}

/// Rates of the motion of a face, m/s and rad/s.
template <class Number>
struct FaceRates {
    Number opening, sliding, turn;
};

/// Rates of a face's motion at the current velocities.
template <class Number>
CRACKLE_INLINE FaceRates<Number> rates_of(const PlaceOf<Number>& place, const MotionOf<Number>& motion,
                                          const FaceBody<Number>& i, const FaceBody<Number>& j,
                                          const FaceBodyRates<Number>& of_i, const FaceBodyRates<Number>& of_j) {
    const VecOf<Number> apart = (of_j.velocity + of_j.spin * perpendicular(j.turned(place.arm_j))) -
                                (of_i.velocity + of_i.spin * perpendicular(i.turned(place.arm_i)));
    const Number spin = 0.5 * (of_i.spin + of_j.spin);
    return {dot(apart, motion.normal) + spin * motion.sliding,
            dot(apart, perpendicular(motion.normal)) - spin * motion.opening, of_j.spin - of_i.spin};
}
/// Rates of one face.
inline FaceRates<double> rates_of(const FacePlace& place, const BondFaceMotion& m, const BodyState& i,
                                  const BodyState& j) {
    return rates_of<double>(place_of(place), {{m.normal.x, m.normal.y}, m.opening, m.sliding, m.turn}, face_body(i),
                            face_body(j), face_body_rates(i), face_body_rates(j));
}

/// Forces of a face along its normal and tangent, and its moment.
template <class Number>
struct ForcesOf {
    Number normal, shear, moment;  // N, N, N m
};

/// Force of a face on body i, N, and its moments on both, N m.
template <class Number>
struct FaceOnBodies {
    VecOf<Number> force;
    Number torque_i, torque_j;
};

/// Forces of a face on its two bodies. They act midway between the two positions to which the bodies have carried the
/// midpoint of the face.
template <class Number>
CRACKLE_INLINE FaceOnBodies<Number> forces_on_bodies(const PlaceOf<Number>& place, const MotionOf<Number>& motion,
                                                     const FaceBody<Number>& i, const FaceBody<Number>& j,
                                                     const ForcesOf<Number>& f) {
    const VecOf<Number> along = perpendicular(motion.normal);
    const VecOf<Number> force = f.normal * motion.normal + f.shear * along;
    const VecOf<Number> half = (0.5 * motion.opening) * motion.normal + (0.5 * motion.sliding) * along;
    return {force, cross(i.turned(place.arm_i) + half, force) + f.moment,
            -cross(j.turned(place.arm_j) - half, force) - f.moment};
}
/// Forces of one face on its two bodies.
inline PointForce forces_on_bodies(const FacePlace& place, const BondFaceMotion& m, const BodyState& i,
                                   const BodyState& j, const FaceForces& f) {
    const FaceOnBodies<double> on =
        forces_on_bodies<double>(place_of(place), {{m.normal.x, m.normal.y}, m.opening, m.sliding, m.turn},
                                 face_body(i), face_body(j), {f.normal, f.shear, f.moment});
    return {on.force.x, on.force.y, on.torque_i, on.torque_j};
}

/// Elastic forces of an intact face. @param length L, m @param pressure p̄, Pa @param skewing τ, Pa
template <class Number>
CRACKLE_INLINE ForcesOf<Number> intact_forces(const Number& normal_stiffness, const Number& shear_stiffness,
                                              const Number& length, const MotionOf<Number>& m, const Number& pressure,
                                              const Number& skewing) {
    return {normal_stiffness * m.opening + length * pressure, shear_stiffness * m.sliding + length * skewing,
            normal_stiffness * length * length / 12.0 * m.turn};
}
/// Elastic forces of one intact face. @param pressure p̄, Pa @param skewing τ, Pa
inline FaceForces intact_forces(const FaceSprings& s, const BondFaceMotion& m, double pressure, double skewing) {
    const ForcesOf<double> f = intact_forces<double>(
        s.normal, s.shear, s.length, {{m.normal.x, m.normal.y}, m.opening, m.sliding, m.turn}, pressure, skewing);
    return {f.normal, f.shear, f.moment};
}

}  // namespace crackle
