// SPDX-License-Identifier: GPL-3.0-or-later
// Finds out which keys the targets determine near a solution. Combinations of keys that remain undetermined are called
// open directions. The standard error of each key ignores them.
// Tested by tests/specimens/calibration/determination_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crackle {

struct OpenDirection {
    Eigen::VectorXd way;  ///< step in each variable; the largest component is `step`
    double change = 0.0;  ///< largest change of a target along the direction, in tolerances
};

struct Determination {
    std::vector<OpenDirection> open;
    Eigen::VectorXd standard_errors;  ///< standard error of each variable, ignoring the open directions
    /// For each variable, whether its component is at most a tenth of the largest one in every open direction.
    std::vector<bool> determined;
};

/// Whether an interval fills nearly the whole range between the bounds and therefore adds no information.
bool fills(double low, double high, double least, double most);

/// Finds the open directions and the standard errors from a singular value decomposition of the slopes. A right
/// singular vector is an open direction if a step along it changes every target by less than half its tolerance.
/// @param slopes  derivatives of the targets, in tolerances: one row per target, one column per variable
/// @param covariance  covariance of the targets' errors, in tolerances squared
Determination determine(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& covariance, double step);

}  // namespace crackle
