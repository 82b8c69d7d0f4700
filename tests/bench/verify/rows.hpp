// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a claim, compared with their tolerance as they are added.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/verify/claim.hpp"

namespace crackle::verification {

/// Errors of the same quantity at two step sizes.
struct Convergence {
    double coarse = 0.0, fine = 0.0;
    double refinement = 2.0;  ///< ratio of the coarse step to the fine step
    double expected_order = 2.0;
};

/// log(coarse/fine)/log(refinement).
double observed_order(const Convergence& errors);

/// Amount by which an observed order may fall short of the expected one, since the next term of the error series still
/// matters at these steps.
inline constexpr double order_slack = 0.3;

class Rows {
  public:
    /// |got - expected| <= tolerance·|expected|. @param estimate origin of the tolerance, in one or two words
    Rows& relative(const std::string& label, double got, double expected, double tolerance,
                   const std::string& estimate);
    /// |got - expected| <= tolerance.
    Rows& absolute(const std::string& label, double got, double expected, double tolerance,
                   const std::string& estimate);
    Rows& at_most(const std::string& label, double got, double limit, const std::string& estimate);
    Rows& at_least(const std::string& label, double got, double limit, const std::string& estimate);
    /// Adds a count or a choice that must equal the expected one.
    Rows& exactly(const std::string& label, double got, double expected);
    /// Adds a value that is shown but not compared.
    Rows& shown(const std::string& label, double got);
    /// Adds the expected value of an option that the engine does not have.
    Rows& unoffered(const std::string& label, double expected);
    /// Adds the observed order to the last row, which fails if the order is more than order_slack below the expected
    /// one.
    Rows& converging(const Convergence& errors);

    std::vector<ClaimRow> take() { return std::move(rows_); }

  private:
    Rows& add(ClaimRow row);
    std::vector<ClaimRow> rows_;
};

}  // namespace crackle::verification
