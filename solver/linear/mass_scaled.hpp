// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and dashpots of a world in mass-scaled coordinates x = M^½ u: M^-½ K M^-½ and M^-½ C M^-½, held degrees of
// freedom left out (under the guide's law K by its symmetric majorant). What the exact stable step and the vibration
// modes are found from.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "solver/linear/springs.hpp"

namespace crackle {

class MassScaled {
  public:
    using Matrix = Eigen::SparseMatrix<double>;
    using Vector = Eigen::VectorXd;

    MassScaled(const World& world, ClosedPoints which);

    Eigen::Index size() const { return static_cast<Eigen::Index>(root_.size()); }
    bool damped() const;

    /// damping_share·M^-½CM^-½ + stiffness_share·M^-½KM^-½, lower triangle.
    Matrix matrix(double damping_share, double stiffness_share) const;

    /// That matrix times x, without making it: of a million bodies it takes gigabytes.
    Vector times(double damping_share, double stiffness_share, const Vector& x) const;

    struct Quotient {
        double damping, stiffness;  ///< xᵀM^-½CM^-½x/xᵀx, 1/s; the same of K, 1/s2
    };
    Quotient quotient(const Vector& x) const;

    /// Between two steps of what is done with it: Workers::hear() of the world that it is of.
    void hear() const {
        if (while_solving_) while_solving_();
    }

    /// u = M^-½ x per body, the largest component of x taken for 1.
    std::vector<BodyMotion> motion(const Vector& x) const;

  private:
    struct Row {
        int number[6];
        double value[6];
        double times(const Vector& x) const;
    };
    Row row_of(const Spring& spring) const;

    std::function<void()> while_solving_;
    std::vector<Spring> springs_;
    std::vector<int> number_;   // per body and degree of freedom: row, -1 where held
    std::vector<double> root_;  // per row: M^-½
};

}  // namespace crackle
