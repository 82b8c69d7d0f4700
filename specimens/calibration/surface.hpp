// SPDX-License-Identifier: GPL-3.0-or-later
// A response surface: what a figure's logarithm does over a region of the free keys, by least squares from points that
// lie wide apart. A single compression is chaotic, so no differences over small steps are taken (Box and Wilson, J. R.
// Stat. Soc. B 13, 1951).
// Tested by tests/specimens/calibration/surface_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crackle {

/// y = c0 + Σ c_i z_i (+ Σ_{i<=j} c_ij z_i z_j), z = x − centre.
class Surface {
  public:
    /// Linear, or quadratic where there are at least two points more than its terms and it predicts points left out
    /// better (leave-one-out).
    /// @param points a column each  @param slopes known ones; not a number: to be found. A known one has no square.
    /// @throws std::invalid_argument if there are fewer points than a linear surface has terms
    Surface(Eigen::VectorXd centre, const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
            const Eigen::VectorXd& slopes);

    double value(const Eigen::VectorXd& x) const;
    Eigen::VectorXd gradient(const Eigen::VectorXd& x) const;

    void shift(double by) { coefficients_[0] += by; }
    bool quadratic() const { return quadratic_; }
    /// Root of the mean square by which points were predicted by the others.
    double left_out_error() const { return left_out_error_; }

  private:
    Eigen::VectorXd terms(const Eigen::VectorXd& x) const;

    Eigen::VectorXd centre_, slopes_;
    std::vector<Eigen::Index> found_;  // variables whose slopes are
    bool quadratic_ = false;
    Eigen::VectorXd coefficients_;
    double left_out_error_ = 0.0;
};

}  // namespace crackle
