// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a claim, compared with their tolerance as they are added.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/verify/claim.hpp"

namespace crackle::verification {

/// Errors of the same quantity at a step and at a smaller one.
struct Convergence {
    double coarse = 0.0, fine = 0.0;
    double refinement = 2.0;  ///< coarse step over fine step
    double expected_order = 2.0;
};

/// log(coarse/fine)/log(refinement).
double observed_order(const Convergence& errors);

/// What an observed order may fall short of by: the next term of the error series is still felt at the steps taken.
inline constexpr double order_slack = 0.3;

class Rows {
  public:
    /// |got - expected| <= tolerance·|expected|. @param estimate where the tolerance comes from, in a word or two
    Rows& relative(const std::string& label, double got, double expected, double tolerance,
                   const std::string& estimate);
    /// |got - expected| <= tolerance.
    Rows& absolute(const std::string& label, double got, double expected, double tolerance,
                   const std::string& estimate);
    Rows& at_most(const std::string& label, double got, double limit, const std::string& estimate);
    Rows& at_least(const std::string& label, double got, double limit, const std::string& estimate);
    /// A count or a choice that has to be met exactly.
    Rows& exactly(const std::string& label, double got, double expected);
    /// A figure that belongs to the claim but is not compared.
    Rows& shown(const std::string& label, double got);
    /// What would be expected of something that the engine does not offer.
    Rows& unoffered(const std::string& label, double expected);
    /// Adds the observed order to the last row, which falls where it is short of the expected one by more than
    /// order_slack.
    Rows& converging(const Convergence& errors);

    std::vector<ClaimRow> take() { return std::move(rows_); }

  private:
    Rows& add(ClaimRow row);
    std::vector<ClaimRow> rows_;
};

}  // namespace crackle::verification
