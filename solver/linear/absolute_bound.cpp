// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/absolute_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/mass_scaled.hpp"

namespace crackle {

double absolute_step_bound(const MassScaled& pencil, int rounds) {
    using Matrix = MassScaled::Matrix;
    using Vector = MassScaled::Vector;
    const auto absolute = [&](double damping, double stiffness) {
        Matrix lower = pencil.matrix(damping, stiffness);
        for (Eigen::Index k = 0; k < lower.nonZeros(); ++k) lower.valuePtr()[k] = std::abs(lower.valuePtr()[k]);
        return lower;
    };
    const Matrix stiffness = absolute(0.0, 1.0);
    const Matrix damping = pencil.damped() ? absolute(1.0, 0.0) : Matrix(pencil.size(), pencil.size());
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
        // A degree of freedom without stiffness keeps its value, which must be > 0.
        for (Eigen::Index n = 0; n < x.size(); ++n)
            if (next[n] > 0.0) x[n] = next[n];
    }
    return best;
}

double absolute_step_bound(const World& world, ClosedPoints which, const LinearRows& rows, int rounds) {
    return absolute_step_bound(MassScaled(world, which, rows), rounds);
}

}  // namespace crackle
