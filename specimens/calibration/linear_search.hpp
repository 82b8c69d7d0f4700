// SPDX-License-Identifier: GPL-3.0-or-later
// Searches for the elastic keys that give the target moduli, using only linear solves.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "specimens/calibration/linear_figures.hpp"
#include "specimens/calibration/search_space.hpp"

namespace crackle {

class LinearSearch {
  public:
    /// @param request  request for linear solves; the constructor sets its `tests`
    LinearSearch(const SearchSpace& space, LinearRequest request);

    bool empty() const { return space_.linear_keys.empty(); }

    /// Adjusts the elastic keys in x until the linear moduli, multiplied by the measured ratios, reach the targets or
    /// come as close as the bounds allow.
    Eigen::VectorXd solve(Eigen::VectorXd x);
    /// Updates the ratios of measured to linear moduli from tests at x.
    /// @param means  logarithms of the mean results for all targets
    void learn(const Eigen::VectorXd& x, const Eigen::VectorXd& means);
    /// Expected deviation from each linear target at x, in tolerances.
    Eigen::VectorXd off(const Eigen::VectorXd& x);
    /// Derivatives of off() with respect to the elastic keys.
    const Eigen::MatrixXd& slopes() const { return slopes_; }
    std::int64_t solves() const { return solves_; }

  private:
    /// Logarithms of the linear moduli at x.
    Eigen::VectorXd logs(const Eigen::VectorXd& x);

    const SearchSpace& space_;
    LinearRequest request_;
    Eigen::VectorXd factors_;  // logarithms of measured result divided by linear result
    Eigen::MatrixXd slopes_;
    std::vector<std::pair<std::vector<double>, Eigen::VectorXd>> known_;
    std::int64_t solves_ = 0;
};

}  // namespace crackle
