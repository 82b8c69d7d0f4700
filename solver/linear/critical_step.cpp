// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/critical_step.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/lanczos_bound.hpp"
#include "solver/linear/mass_scaled.hpp"
#include "solver/linear/step_bound.hpp"

namespace crackle {
namespace {

using Matrix = MassScaled::Matrix;
using Vector = MassScaled::Vector;

constexpr double lanczos_tolerance =
    1e-10;  // of the eigenvalue; its vector errs by the root, the quotient by this again
constexpr Eigen::Index lanczos_vectors = 40;
constexpr Eigen::Index lanczos_restarts = 2000;
constexpr int newton_steps = 30;
constexpr double newton_tolerance = 1e-10;

/// A symmetric matrix of which the lower triangle is stored, as Spectra wants to multiply by it.
class Multiply {
  public:
    using Scalar = double;
    Multiply(const MassScaled& pencil, const Matrix& lower)
        : pencil_(pencil), full_(lower.selfadjointView<Eigen::Lower>()) {}
    Eigen::Index rows() const { return full_.rows(); }
    Eigen::Index cols() const { return full_.cols(); }
    void perform_op(const double* in, double* out) const {
        pencil_.hear();
        Eigen::Map<Vector>(out, rows()).noalias() = full_ * Eigen::Map<const Vector>(in, cols());
    }

  private:
    const MassScaled& pencil_;
    Matrix full_;
};

/// Vector of the largest eigenvalue. Starts at random numbers of a fixed seed (Spectra's), so it is the same every
/// time.
Vector extreme_vector(const MassScaled& pencil, double damping_share, double stiffness_share) {
    const Matrix lower = pencil.matrix(damping_share, stiffness_share);
    const Eigen::Index n = lower.rows();
    if (lower.squaredNorm() == 0.0) return Vector::Unit(n, 0);  // nothing is closed, and Lanczos has nothing to go by
    if (n <= lanczos_vectors) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense{Eigen::MatrixXd(lower)};  // reads the lower triangle
        return dense.eigenvectors().col(n - 1);
    }
    Multiply multiply(pencil, lower);
    Spectra::SymEigsSolver<Multiply> solver(multiply, 1, lanczos_vectors);
    solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, lanczos_restarts, lanczos_tolerance);
    // Where it has not converged its best vector still bounds the limit from above; Cholesky checks the result.
    if (solver.info() == Spectra::CompInfo::Successful) return solver.eigenvectors(1).col(0);
    return Vector();
}

bool positive_definite(const MassScaled& pencil, double dt) {
    Matrix rest(pencil.size(), pencil.size());
    rest.setIdentity();
    rest = 4.0 * rest - pencil.matrix(2.0 * dt, dt * dt);
    pencil.hear();
    const Eigen::SimplicialLLT<Matrix, Eigen::Lower> factor(rest);
    pencil.hear();
    return factor.info() == Eigen::Success;
}

/// Root of 4 - 2Δt c - Δt² k.
double step_of(const MassScaled::Quotient& q) {
    return 4.0 / (std::sqrt(q.damping * q.damping + 4.0 * q.stiffness) + q.damping);
}

}  // namespace

CriticalStep critical_step(const World& world, ClosedPoints which) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const MassScaled pencil(world, which);
    const double guaranteed = stable_step_bound(world);  // over all listed points: never above the limit sought
    CriticalStep result{guaranteed, infinite, false, std::vector<BodyMotion>(world.bodies.size())};
    if (pencil.size() == 0 || !std::isfinite(guaranteed)) return {infinite, infinite, true, result.mode};
    const auto unproved = [&] {
        result.step = std::max(guaranteed, lanczos_step(pencil, guaranteed));
        result.proved = std::isinf(result.step);  // nothing is closed
        return result;
    };
    if (pencil.size() > most_exact_unknowns) return unproved();
    const bool damped = pencil.damped();
    double dt = guaranteed;
    for (int n = 0; n < newton_steps; ++n) {
        const Vector x = extreme_vector(pencil, 2.0 * dt, dt * dt);
        if (x.size() == 0) return unproved();
        const MassScaled::Quotient q = pencil.quotient(x);
        if (q.damping == 0.0 && q.stiffness == 0.0)
            return {infinite, infinite, true, result.mode};  // nothing is closed
        const double next = step_of(q);
        result.mode = pencil.motion(x);
        const bool done = !damped || std::abs(next - dt) <= newton_tolerance * dt;
        dt = next;
        if (done) break;
    }
    result.root = dt;
    result.proved = positive_definite(pencil, dt * (1.0 - critical_step_margin));
    if (!result.proved) return unproved();
    result.step = dt * (1.0 - critical_step_margin);
    return result;
}

bool stable_at(const World& world, ClosedPoints which, double dt) {
    const MassScaled pencil(world, which);
    if (pencil.size() > most_exact_unknowns) return dt <= stable_step_bound(world) || lanczos_finds_stable(pencil, dt);
    return pencil.size() == 0 || positive_definite(pencil, dt / (1.0 - critical_step_margin));
}

double growth_per_step(const World& world, ClosedPoints which, double dt) {
    const MassScaled pencil(world, which);
    double zeta = 1.0;
    for (int n = 0; n < newton_steps; ++n) {
        const Vector x = extreme_vector(pencil, dt / (1.0 + zeta), dt * dt * zeta / ((1.0 + zeta) * (1.0 + zeta)));
        if (x.size() == 0) break;
        // Larger root of ζ² + (2 - Δt c - Δt² k)ζ + 1 - Δt c = 0
        const MassScaled::Quotient q = pencil.quotient(x);
        const double b = 2.0 - dt * q.damping - dt * dt * q.stiffness, c = 1.0 - dt * q.damping;
        const double inside = 0.25 * b * b - c;
        const double next = inside > 0.0 ? std::max(1.0, -0.5 * b + std::sqrt(inside)) : 1.0;
        const bool done = std::abs(next - zeta) <= newton_tolerance;
        zeta = next;
        if (done) break;
    }
    return zeta;
}

}  // namespace crackle
