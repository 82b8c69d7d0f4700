// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and dashpots of a world in mass-scaled coordinates x = M^½ u: M^-½ K M^-½ and M^-½ C M^-½, without held
// degrees of freedom. Under the DEMseg guide's segment law, K is replaced by its symmetric majorant. The exact stable
// time step and the vibration modes are computed from these matrices.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "solver/linear/linear_rows.hpp"
#include "solver/linear/springs.hpp"

namespace crackle {

/// Stiffness and damping of a world in mass-scaled coordinates.
class MassScaled {
  public:
    using Matrix = Eigen::SparseMatrix<double>;
    using Vector = Eigen::VectorXd;

    /// Assembles the matrices from the faces and contact points of a world. @param which points that count as springs
    MassScaled(const World& world, ClosedPoints which);

    /// Number of free degrees of freedom.
    Eigen::Index size() const { return static_cast<Eigen::Index>(root_.size()); }
    /// Whether any spring or row has a dashpot.
    bool damped() const;

    /// Lower triangle of damping_share·M^-½CM^-½ + stiffness_share·M^-½KM^-½.
    Matrix matrix(double damping_share, double stiffness_share) const;

    /// Product of matrix() with x, computed without assembling the matrix, which would take gigabytes for a million
    /// bodies.
    Vector times(double damping_share, double stiffness_share, const Vector& x) const;

    /// Rayleigh quotients of a vector.
    struct Quotient {
        double damping, stiffness;  ///< 1/s and 1/s2: Rayleigh quotients xᵀM^-½CM^-½x/xᵀx and xᵀM^-½KM^-½x/xᵀx
    };
    /// Rayleigh quotients of a vector. @param x nonzero vector with size() components
    Quotient quotient(const Vector& x) const;

    /// Calls Workers::while_solving of the world, if set. Call it between the iterations of a solve.
    void hear() const {
        if (while_solving_) while_solving_();
    }

    /// u = M^-½ x, by body, scaled so that the largest component of x is 1.
    std::vector<BodyMotion> motion(const Vector& x) const;

  private:
    struct Row {
        int number[6];
        double value[6];
        double times(const Vector& x) const;
    };
    Row row_of(const Spring& spring) const;

    std::function<void()> while_solving_;
    int number_of(const RowEntry& entry) const {
        return number_[3 * std::size_t{entry.body} + static_cast<std::size_t>(entry.freedom)];
    }
    /// Product of one of `rows_` with x.
    double times_row(const LinearRow& row, const Vector& x) const;

    std::vector<Spring> springs_;
    LinearRows rows_;
    std::vector<int> number_;   // row index by body and degree of freedom; -1 if held
    std::vector<double> root_;  // M^-½, by row
};

}  // namespace crackle
