// SPDX-License-Identifier: GPL-3.0-or-later
// A response surface: the logarithm of a result as a polynomial of the free keys over a region, fitted by least squares
// to widely spaced points. A compression test is chaotic, so finite differences over small steps are not used (Box and
// Wilson, J. R. Stat. Soc. B 13, 1951).
// Tested by tests/specimens/calibration/surface_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crackle {

/// y = c0 + Σ c_i z_i (+ Σ_{i<=j} c_ij z_i z_j), z = x − centre.
class Surface {
  public:
    /// Fits a linear surface, or a quadratic one if that predicts left-out points better (leave-one-out). A quadratic
    /// surface also requires at least two points more than it has terms.
    /// @param points  points of the fit, one column each
    /// @param slopes  known slope of each variable; NaN if the slope is to be fitted. A variable with a known slope has
    /// no square term.
    /// @throws std::invalid_argument if there are fewer points than a linear surface has terms
    Surface(Eigen::VectorXd centre, const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
            const Eigen::VectorXd& slopes);

    double value(const Eigen::VectorXd& x) const;
    Eigen::VectorXd gradient(const Eigen::VectorXd& x) const;

    void shift(double by) { coefficients_[0] += by; }
    bool quadratic() const { return quadratic_; }
    /// Root mean square error when each point is predicted from the others.
    double left_out_error() const { return left_out_error_; }

  private:
    Eigen::VectorXd terms(const Eigen::VectorXd& x) const;

    Eigen::VectorXd centre_, slopes_;
    std::vector<Eigen::Index> found_;  // variables whose slopes are fitted
    bool quadratic_ = false;
    Eigen::VectorXd coefficients_;
    double left_out_error_ = 0.0;
};

}  // namespace crackle
