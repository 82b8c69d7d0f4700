// SPDX-License-Identifier: GPL-3.0-or-later
// Angle of a vector, and unit vector at an angle, computed only from sums, products and square roots, which all
// processors round identically. The sine of a mathematical library may differ in the last digit between machines, and
// then so would the seeds. Tested by tests/mesher/angles_test.cpp.
#pragma once

#include <cmath>
#include <numbers>

#include "mesher/mesher.hpp"

namespace crackle {

/// Angle of a direction, rad, from -π to π, with an error of about 1e-15. The angle is reduced to half a quadrant. Then
/// the tangent of an eighth of the angle is computed and inserted into the arctangent series.
inline double angle_of(double x, double y) {
    const bool steep = std::abs(y) > std::abs(x);
    double t = steep ? std::abs(x / y) : std::abs(y / x);  // at most 1
    for (int halving = 0; halving < 3; ++halving) t /= 1.0 + std::sqrt(1.0 + t * t);
    double sum = 0.0;
    for (int k = 10; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t * t * sum;
    double angle = 8.0 * t * sum;
    if (steep) angle = 0.5 * std::numbers::pi - angle;
    if (x < 0.0) angle = std::numbers::pi - angle;
    return y < 0.0 ? -angle : angle;
}

/// Unit vector at an angle of at most a few turns, rad: sums the series for 1/64 of the angle and doubles the angle six
/// times.
inline Point direction_at(double angle) {
    const double part = angle / 64.0, square = part * part;
    double sine = 0.0, lack = 0.0;  // lack is 1 - cosine, stored in this form to keep all digits
    double term = part;
    for (int k = 1; k <= 15; k += 2) {
        sine += term;
        term *= -square / ((k + 1) * (k + 2));
    }
    term = 0.5 * square;
    for (int k = 2; k <= 16; k += 2) {
        lack += term;
        term *= -square / ((k + 1) * (k + 2));
    }
    for (int doubling = 0; doubling < 6; ++doubling) {
        const double twice = 2.0 * sine * (1.0 - lack);
        lack = 2.0 * sine * sine;
        sine = twice;
    }
    return {1.0 - lack, sine};
}

}  // namespace crackle
