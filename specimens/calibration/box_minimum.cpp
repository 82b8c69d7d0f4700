// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/box_minimum.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace crackle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A point counts as a minimum if no component of the steepest-descent step, cut off at the bounds, exceeds this value.
// Derivatives are scaled to order one.
constexpr double close_to_bottom = 1e-7;
constexpr int most_restarts = 30;

struct Objective {
    const Residuals& residuals;
    double scale = 1.0;

    /// Returns the scaled sum of squares at x, and sets `gradient` to the gradient of that scaled sum.
    double operator()(const VectorXd& x, VectorXd& gradient) const {
        VectorXd r;
        MatrixXd jacobian;
        residuals(x, r, jacobian);
        gradient = 2.0 * scale * jacobian.transpose() * r;
        return scale * r.squaredNorm();
    }
};

double objective(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    VectorXd slope;
    const double value = (*static_cast<const Objective*>(data))(
        Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size())), slope);
    if (!gradient.empty()) std::copy(slope.begin(), slope.end(), gradient.begin());
    return value;
}

/// Largest component of the steepest-descent step after it is cut off at the bounds.
double way_left(const VectorXd& x, const VectorXd& gradient, const VectorXd& low, const VectorXd& high) {
    return ((x - 0.5 * gradient).cwiseMax(low).cwiseMin(high) - x).cwiseAbs().maxCoeff();
}

}  // namespace

VectorXd box_minimum(const Residuals& residuals, const VectorXd& start, const VectorXd& low, const VectorXd& high) {
    if (start.size() == 0) return start;
    VectorXd best = start.cwiseMax(low).cwiseMin(high), gradient;
    Objective sum{residuals};
    double least = 0.0;
    for (int k = 0; k < most_restarts; ++k) {
        // SLSQP starts from the identity matrix as Hessian, so the objective is scaled to second derivatives of about
        // one.
        VectorXd r;
        MatrixXd jacobian;
        residuals(best, r, jacobian);
        const double curvature = jacobian.squaredNorm();
        if (!(curvature > 0.0)) return best;
        sum.scale = 1.0 / curvature;
        least = sum(best, gradient);
        if (way_left(best, gradient, low, high) < close_to_bottom) return best;
        // SLSQP and CCSAQ alternate, because one of them can continue where the other stopped early.
        nlopt::opt search(k % 2 == 0 ? nlopt::LD_SLSQP : nlopt::LD_CCSAQ, static_cast<unsigned>(start.size()));
        search.set_min_objective(objective, &sum);
        search.set_lower_bounds({low.data(), low.data() + low.size()});
        search.set_upper_bounds({high.data(), high.data() + high.size()});
        search.set_xtol_rel(1e-12);
        search.set_maxeval(400);
        std::vector<double> x(best.data(), best.data() + best.size());
        double value = 0.0;
        try {
            search.optimize(x, value);
        } catch (const std::runtime_error&) {  // the optimiser gave up; x is its best point
        }
        const VectorXd there = Eigen::Map<const VectorXd>(x.data(), start.size()).cwiseMax(low).cwiseMin(high);
        if (sum(there, gradient) < least) best = there;
    }
    return best;
}

}  // namespace crackle
