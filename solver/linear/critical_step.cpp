// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/critical_step.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linear/absolute_bound.hpp"
#include "solver/linear/lanczos_bound.hpp"
#include "solver/linear/mass_scaled.hpp"
#include "solver/linear/step_bound.hpp"

namespace crackle {
namespace {

using Matrix = MassScaled::Matrix;
using Vector = MassScaled::Vector;

// Relative error of the eigenvalue and of the Rayleigh quotient; the error of the eigenvector is the square root of
// this value.
constexpr double lanczos_tolerance = 1e-10;
constexpr Eigen::Index lanczos_vectors = 40;
constexpr Eigen::Index lanczos_restarts = 2000;
constexpr int newton_steps = 30;
constexpr double newton_tolerance = 1e-10;

/// Multiplies by a symmetric matrix given by its lower triangle; has the interface that Spectra requires.
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

/// Eigenvector of the largest eigenvalue. Spectra starts from random numbers with a fixed seed, so the result is
/// reproducible.
Vector extreme_vector(const MassScaled& pencil, double damping_share, double stiffness_share) {
    const Matrix lower = pencil.matrix(damping_share, stiffness_share);
    const Eigen::Index n = lower.rows();
    if (lower.squaredNorm() == 0.0)
        return Vector::Unit(n, 0);  // without closed points the matrix is zero, and Lanczos cannot start
    if (n <= lanczos_vectors) {
        // SelfAdjointEigenSolver reads only the lower triangle.
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense{Eigen::MatrixXd(lower)};
        return dense.eigenvectors().col(n - 1);
    }
    Multiply multiply(pencil, lower);
    Spectra::SymEigsSolver<Multiply> solver(multiply, 1, lanczos_vectors);
    solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, lanczos_restarts, lanczos_tolerance);
    // Without convergence, the best vector so far still bounds the limit from above; Cholesky checks the result.
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

bool is_too_large(const World& world, const MassScaled& pencil) {
    return pencil.size() > (world.faces.size() == 0 ? most_exact_unknowns : most_exact_unknowns_of_faces);
}

/// Positive root Δt of 4 - 2Δt c - Δt² k = 0, with c and k the quotients for damping and stiffness.
double step_of(const MassScaled::Quotient& q) {
    return 4.0 / (std::sqrt(q.damping * q.damping + 4.0 * q.stiffness) + q.damping);
}

}  // namespace

CriticalStep critical_step(const World& world, ClosedPoints which) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const MassScaled pencil(world, which);
    // This bound holds for all listed points, so it is never above the exact limit.
    const double guaranteed = world.faces.size() == 0 ? stable_step_bound(world) : absolute_step_bound(pencil);
    CriticalStep result{guaranteed, infinite, false, std::vector<BodyMotion>(world.bodies.size())};
    if (pencil.size() == 0 || !std::isfinite(guaranteed)) return {infinite, infinite, true, result.mode};
    const auto unproved = [&] {
        result.step = std::max(guaranteed, lanczos_step(pencil, guaranteed));
        result.proved = std::isinf(result.step);  // the step is infinite only if no point is closed
        return result;
    };
    if (is_too_large(world, pencil)) return unproved();
    const bool damped = pencil.damped();
    double dt = guaranteed;
    for (int n = 0; n < newton_steps; ++n) {
        const Vector x = extreme_vector(pencil, 2.0 * dt, dt * dt);
        if (x.size() == 0) return unproved();
        const MassScaled::Quotient q = pencil.quotient(x);
        if (q.damping == 0.0 && q.stiffness == 0.0) return {infinite, infinite, true, result.mode};  // no closed points
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
    if (is_too_large(world, pencil)) return dt <= stable_step_bound(world) || lanczos_finds_stable(pencil, dt);
    return pencil.size() == 0 || positive_definite(pencil, dt / (1.0 - critical_step_margin));
}

double growth_per_step(const World& world, ClosedPoints which, double dt) {
    const MassScaled pencil(world, which);
    double zeta = 1.0;
    for (int n = 0; n < newton_steps; ++n) {
        const Vector x = extreme_vector(pencil, dt / (1.0 + zeta), dt * dt * zeta / ((1.0 + zeta) * (1.0 + zeta)));
        if (x.size() == 0) break;
        // The larger root of ζ² + (2 - Δt c - Δt² k)ζ + 1 - Δt c = 0.
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
