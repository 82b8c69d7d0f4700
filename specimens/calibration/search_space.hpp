// SPDX-License-Identifier: GPL-3.0-or-later
// A rock in numbers: its free keys as variables (mostly logarithms) within bounds, its targets as logarithms with a
// width, and which of both belong to the linear solve. Tested by tests/specimens/calibration/rock_test.cpp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "specimens/calibration/rock.hpp"

namespace crackle {

struct SearchSpace {
    explicit SearchSpace(const Rock& rock);

    const Rock& rock;
    Eigen::Index keys = 0, targets = 0;
    Eigen::VectorXd low, high, start;  ///< of the variables
    Eigen::VectorXd logs, widths;      ///< of the targets: logarithm, and that of 1 + tolerance
    /// Moduli and what they depend on; none where there are only the ones or the others. The other keys are those that
    /// the other targets are to determine: none without such targets, then keys stay where they start.
    std::vector<Eigen::Index> linear_keys, linear_targets, other_keys, other_targets;
    /// tensile_strength, where strengths go with its first power up to strength over modulus: cohesion goes with it,
    /// and bonds are coulomb in all tests; -1 elsewhere.
    Eigen::Index level_key = -1;

    std::vector<double> values_at(const Eigen::VectorXd& x) const;
    const Target& target(Eigen::Index t) const { return rock.targets[static_cast<std::size_t>(t)]; }
    const FreeKey& key(Eigen::Index k) const { return rock.free[static_cast<std::size_t>(k)]; }
    /// Whether it is a strength, which goes with the level; one under a pressure, which does not change, does not.
    bool goes_with_level(Eigen::Index t) const;
};

}  // namespace crackle
