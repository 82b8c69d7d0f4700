// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric 3 by 3 matrix of a body's degrees of freedom, and bounds on its largest eigenvalue.
// Tested by tests/solver/linear/step_bound_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

namespace crackle {

/// Symmetric matrix of a body's scaled degrees of freedom (x, y, rotation).
struct SymmetricBlock {
    double xx = 0.0, yy = 0.0, rr = 0.0, xy = 0.0, xr = 0.0, yr = 0.0;

    /// Adds s·vvᵀ with v = (x, y, r).
    void add(double s, double x, double y, double r) {
        if (s == 0.0) return;  // for example, if there is no damping
        xx += s * x * x;
        yy += s * y * y;
        rr += s * r * r;
        xy += s * x * y;
        xr += s * x * r;
        yr += s * y * r;
    }
};

/// Mean eigenvalue of a matrix, and its diagonal entries minus this mean. p² is a sixth of the sum of the squares of
/// all entries after the mean has been subtracted from the diagonal.
struct EigenvalueSpread {
    double mean, dx, dy, dr, p;
};
inline EigenvalueSpread spread_of(const SymmetricBlock& m) {
    const double off = m.xy * m.xy + m.xr * m.xr + m.yr * m.yr;
    const double mean = (m.xx + m.yy + m.rr) / 3.0;
    const double dx = m.xx - mean, dy = m.yy - mean, dr = m.rr - mean;
    return {mean, dx, dy, dr, std::sqrt((dx * dx + dy * dy + dr * dr + 2.0 * off) / 6.0)};
}

/// cos(arccos(c)/3), the largest root x of 4x³ - 3x = c. With x = ½ + e, Newton's method solves 6e² + 4e³ = 1 + c from
/// above, starting from e = √((1 + c)/6). The first e is at most 16 % too large; after four iterations only round-off
/// remains.
inline double cosine_of_a_third(double c) {
    const double rise = 1.0 + c;
    double e = std::sqrt(rise / 6.0);
    if (e == 0.0) return 0.5;
    for (int k = 0; k < 4; ++k) e -= (e * e * (6.0 + 4.0 * e) - rise) / (12.0 * e * (1.0 + e));
    return 0.5 + e;
}

/// Largest eigenvalue by Cardano's formula for symmetric matrices (Smith 1961), increased by the round-off of this
/// computation.
inline double largest_eigenvalue(const SymmetricBlock& m) {
    const auto [mean, dx, dy, dr, p] = spread_of(m);
    if (p == 0.0) return mean;
    const double half_det =
        (dx * (dy * dr - m.yr * m.yr) - m.xy * (m.xy * dr - m.yr * m.xr) + m.xr * (m.xy * m.yr - dy * m.xr)) /
        (2.0 * p * p * p);
    return (mean + 2.0 * p * cosine_of_a_third(std::clamp(half_det, -1.0, 1.0))) * (1.0 + 1e-12);
}

/// Upper bound on the largest eigenvalue, with only one square root: the cosine in Cardano's formula is at most 1.
inline double eigenvalue_at_most(const SymmetricBlock& m) {
    const EigenvalueSpread spread = spread_of(m);
    return (spread.mean + 2.0 * spread.p) * (1.0 + 1e-11);
}

}  // namespace crackle
