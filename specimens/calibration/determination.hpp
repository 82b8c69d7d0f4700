// SPDX-License-Identifier: GPL-3.0-or-later
// What targets say of keys near a solution: which combinations they leave open, and how sure the others are.
// Tested by tests/specimens/calibration/determination_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crackle {

struct OpenDirection {
    Eigen::VectorXd way;  ///< of the variables, the largest by `step`
    double change = 0.0;  ///< of the target that changes most along it, in tolerances
};

struct Determination {
    std::vector<OpenDirection> open;
    Eigen::VectorXd standard_errors;  ///< of the variables, of what is determined
    std::vector<bool> determined;     ///< a variable each: no open direction has more than a tenth of it
};

/// Whether an interval leaves next to nothing of the bounds: it says no more than they do.
bool fills(double low, double high, double least, double most);

/// By the singular directions of the slopes: one along which a step changes no target by half a tolerance is open.
/// @param slopes of the targets in tolerances, a row each, over the variables
/// @param covariance of the targets' errors, in tolerances squared
Determination determine(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& covariance, double step);

}  // namespace crackle
