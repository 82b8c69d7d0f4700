// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic keys from moduli, by linear solves alone.
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
    /// @param request but for its tests
    LinearSearch(const SearchSpace& space, LinearRequest request);

    bool empty() const { return space_.linear_keys.empty(); }

    /// Moves the elastic keys of x until the linear moduli, times what tests measure beside them, are the targets, or
    /// as near as their bounds allow.
    Eigen::VectorXd solve(Eigen::VectorXd x);
    /// What tests at x have measured beside the linear figures there. @param means logarithms, of all targets
    void learn(const Eigen::VectorXd& x, const Eigen::VectorXd& means);
    /// What is expected to be measured at x, less the target, in tolerances; a row a linear target.
    Eigen::VectorXd off(const Eigen::VectorXd& x);
    /// Of off() over the elastic keys.
    const Eigen::MatrixXd& slopes() const { return slopes_; }
    std::int64_t solves() const { return solves_; }

  private:
    /// Logarithms of the linear figures.
    Eigen::VectorXd logs(const Eigen::VectorXd& x);

    const SearchSpace& space_;
    LinearRequest request_;
    Eigen::VectorXd factors_;  // logarithms of measured over linear
    Eigen::MatrixXd slopes_;
    std::vector<std::pair<std::vector<double>, Eigen::VectorXd>> known_;
    std::int64_t solves_ = 0;
};

}  // namespace crackle
