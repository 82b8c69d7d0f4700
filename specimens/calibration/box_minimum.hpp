// SPDX-License-Identifier: GPL-3.0-or-later
// Minimises a sum of squares within bounds. The residuals must be smooth and cheap to evaluate.
// Tested by tests/specimens/calibration/surface_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace crackle {

/// Computes the residuals at x and their derivatives, one row of the Jacobian per residual.
using Residuals = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian)>;

/// Minimises the sum of squared residuals by sequential quadratic programming (Kraft, TOMS 20, 1994; NLopt's SLSQP),
/// with the objective scaled to second derivatives of about one. If it stops early, conservative convex approximations
/// (Svanberg, SIAM J. Optim. 12, 2002; CCSAQ) continue until no step within the bounds lowers the sum.
/// @param start  a point within the bounds
Eigen::VectorXd box_minimum(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                            const Eigen::VectorXd& high);

}  // namespace crackle
