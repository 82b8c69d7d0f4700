// SPDX-License-Identifier: GPL-3.0-or-later
// Smallest sum of squares within bounds, of functions that are smooth and cheap.
// Tested by tests/specimens/calibration/surface_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace crackle {

/// Residuals at x, and their derivatives, a row a residual.
using Residuals = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian)>;

/// Sequential quadratic programming (Kraft, TOMS 20, 1994; NLopt's SLSQP) with the second derivatives scaled to one,
/// and from where that gives up by conservative convex models (Svanberg, SIAM J. Optim. 12, 2002; CCSAQ), until the
/// gradient leads nowhere within the bounds.
/// @param start within the bounds
Eigen::VectorXd box_minimum(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                            const Eigen::VectorXd& high);

}  // namespace crackle
