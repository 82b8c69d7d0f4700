// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/vibration.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"
#include "solver/linear/mass_scaled.hpp"

namespace crackle {
namespace {

using Matrix = MassScaled::Matrix;
using Vector = MassScaled::Vector;

constexpr double tolerance = 1e-8;
constexpr Eigen::Index restarts = 1000;
// Fraction of the largest diagonal entry that is added to the diagonal, to keep the factorisation regular when some
// motions store no energy.
constexpr double shift_share = 1e-12;

/// Multiplies by (A - σ)^-1 as Spectra requires; σ < 0 makes A - σ positive definite.
class Inverse {
  public:
    using Scalar = double;
    Inverse(const MassScaled& system, const Matrix& lower) : system_(system), lower_(lower) {}
    Eigen::Index rows() const { return lower_.rows(); }
    Eigen::Index cols() const { return lower_.cols(); }
    void set_shift(double sigma) {
        Matrix identity(rows(), rows());
        identity.setIdentity();
        factor_.compute(lower_ - sigma * identity);
        if (factor_.info() != Eigen::Success)
            throw InputError("vibration modes: the stiffness matrix could not be factorised; is any body bonded?");
    }
    void perform_op(const double* in, double* out) const {
        system_.hear();
        Eigen::Map<Vector>(out, rows()) = factor_.solve(Eigen::Map<const Vector>(in, cols()));
    }

  private:
    const MassScaled& system_;
    const Matrix& lower_;
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
};

}  // namespace

std::vector<VibrationMode> lowest_modes(const World& world, std::int64_t count, std::int64_t free_motions) {
    const MassScaled system(world, ClosedPoints::bonded);
    const std::int64_t all = count + free_motions;
    if (all > most_modes || all >= system.size()) {
        throw InputError(
            fmt::format("vibration modes: found {} modes requested, and {} zero-energy motions, expected at most {} "
                        "in total and fewer than the {} degrees of freedom; request fewer modes",
                        count, free_motions, most_modes, system.size()));
    }
    const Matrix stiffness = system.matrix(0.0, 1.0);
    const double sigma = -shift_share * stiffness.diagonal().maxCoeff();
    Inverse inverse(system, stiffness);
    const auto wanted = static_cast<Eigen::Index>(all);
    const Eigen::Index vectors = std::min<Eigen::Index>(system.size(), 2 * wanted + 20);
    Spectra::SymEigsShiftSolver<Inverse> solver(inverse, wanted, vectors, sigma);
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, restarts, tolerance, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful)
        throw InputError("vibration modes: the eigenvalue iteration did not converge; request fewer modes");
    std::vector<VibrationMode> modes;
    for (auto n = static_cast<Eigen::Index>(free_motions); n < wanted; ++n) {
        const Vector x = solver.eigenvectors().col(n);
        modes.push_back({std::sqrt(system.quotient(x).stiffness), system.motion(x)});
    }
    std::sort(modes.begin(), modes.end(),
              [](const VibrationMode& a, const VibrationMode& b) { return a.frequency < b.frequency; });
    return modes;
}

}  // namespace crackle
