// SPDX-License-Identifier: GPL-3.0-or-later
// A rock in numerical form for the search: free keys as variables (mostly logarithms) within bounds, and targets as
// logarithms with tolerances. It also lists the keys and targets that belong to the linear solve.
// Tested by tests/specimens/calibration/rock_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "specimens/calibration/rock.hpp"

namespace crackle {

struct SearchSpace {
    explicit SearchSpace(const Rock& rock);

    const Rock& rock;
    Eigen::Index keys = 0, targets = 0;
    Eigen::VectorXd low, high, start;  ///< bounds and start values of the variables
    Eigen::VectorXd logs, widths;      ///< logarithm of each target, and of 1 + its tolerance
    /// Indices of keys and targets. The targets in linear_targets are moduli and depend only on linear_keys. Without
    /// elastic keys or without moduli, both lists are empty. The other_keys are fitted to the other_targets; without
    /// other targets, other_keys is empty, and the remaining keys keep their start values.
    std::vector<Eigen::Index> linear_keys, linear_targets, other_keys, other_targets;
    /// Index of tensile_strength if all strengths are proportional to it (apart from the effect of the ratio of
    /// strength to modulus); otherwise -1. This requires cohesion given as a ratio to tensile_strength, and Coulomb
    /// bonds in all tests.
    Eigen::Index level_key = -1;

    std::vector<double> values_at(const Eigen::VectorXd& x) const;
    const Target& target(Eigen::Index t) const { return rock.targets[static_cast<std::size_t>(t)]; }
    const FreeKey& key(Eigen::Index k) const { return rock.free[static_cast<std::size_t>(k)]; }
    /// Whether a target is a strength that scales with the level key. A strength under a confining pressure does not,
    /// because the pressure does not scale with it.
    bool goes_with_level(Eigen::Index t) const;
};

}  // namespace crackle
