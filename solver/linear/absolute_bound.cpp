// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/absolute_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/mass_scaled.hpp"

namespace crackle {

namespace {

using Matrix = MassScaled::Matrix;
using Vector = MassScaled::Vector;

/// Lower triangle of the absolute values of MassScaled::matrix().
Matrix absolute(const MassScaled& pencil, double damping, double stiffness) {
    Matrix lower = pencil.matrix(damping, stiffness);
    for (Eigen::Index k = 0; k < lower.nonZeros(); ++k) lower.valuePtr()[k] = std::abs(lower.valuePtr()[k]);
    return lower;
}

/// Upper bound on the largest eigenvalue of a matrix with entries >= 0.
double eigenvalue_at_most(const Matrix& lower, int rounds) {
    double best = std::numeric_limits<double>::infinity();
    Vector x = Vector::Ones(lower.rows());
    for (int round = 0; round < rounds; ++round) {
        const Vector next = lower.selfadjointView<Eigen::Lower>() * x;
        double most = 0.0;
        for (Eigen::Index n = 0; n < x.size(); ++n) most = std::max(most, next[n] / x[n]);
        best = std::min(best, most);
        // For a degree of freedom without stiffness, the component of x is not changed, since it must stay > 0.
        for (Eigen::Index n = 0; n < x.size(); ++n)
            if (next[n] > 0.0) x[n] = next[n] / most;
    }
    return best;
}

}  // namespace

double absolute_step_bound(const MassScaled& pencil, int rounds) {
    const Matrix stiffness = absolute(pencil, 0.0, 1.0);
    const Matrix damping = pencil.damped() ? absolute(pencil, 1.0, 0.0) : Matrix(pencil.size(), pencil.size());
    double best = 0.0;
    Vector x = Vector::Ones(pencil.size());
    for (int round = 0; round < rounds; ++round) {
        const Vector k = stiffness.selfadjointView<Eigen::Lower>() * x, c = damping.selfadjointView<Eigen::Lower>() * x;
        double step = std::numeric_limits<double>::infinity();
        for (Eigen::Index n = 0; n < x.size(); ++n) {
            const double per_k = k[n] / x[n], per_c = c[n] / x[n];
            if (per_k > 0.0 || per_c > 0.0)
                step = std::min(step, 4.0 / (std::sqrt(per_c * per_c + 4.0 * per_k) + per_c));
        }
        if (std::isinf(step)) return step;
        best = std::max(best, step);
        const Vector next = 2.0 * step * c + step * step * k;
        // For a degree of freedom without stiffness, the component of x is not changed, since it must stay > 0.
        for (Eigen::Index n = 0; n < x.size(); ++n)
            if (next[n] > 0.0) x[n] = next[n];
    }
    return best;
}

double absolute_step_bound(const World& world, ClosedPoints which, int rounds) {
    return absolute_step_bound(MassScaled(world, which), rounds);
}

void bound_faces(World& world, int rounds) {
    const MassScaled pencil(world, ClosedPoints::bonded);
    world.faces.stiffness_bound = eigenvalue_at_most(absolute(pencil, 0.0, 1.0), rounds);
    world.faces.damping_bound = pencil.damped() ? eigenvalue_at_most(absolute(pencil, 1.0, 0.0), rounds) : 0.0;
}

}  // namespace crackle
