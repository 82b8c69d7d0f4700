// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/lanczos_bound.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "solver/base/correctly_rounded.hpp"
#include "solver/linear/mass_scaled.hpp"

namespace crackle {
namespace {

using Vector = MassScaled::Vector;

constexpr int search_steps = 40;   // Lanczos steps per iteration of the search for the time step
constexpr int most_searches = 20;  // two or three searches are usually enough

/// Number of Lanczos steps for which the probability stated in lanczos_bound.hpp is lanczos_failure.
int sufficient_steps(Eigen::Index rows) {
    const double certainty = correctly_rounded::log(1.648 * std::sqrt(static_cast<double>(rows)) / lanczos_failure);
    return static_cast<int>(std::ceil(0.5 * (certainty / std::sqrt(lanczos_share) + 1.0)));
}

/// A vector with normally distributed components, so that all directions are equally likely.
Vector random_start(Eigen::Index rows) {
    std::mt19937_64 generator(1);
    Vector start(rows);
    for (double& component : start) {
        constexpr double spacing = 0x1p-52;
        component = correctly_rounded::normal_quantile((static_cast<double>(generator() >> 12) + 0.5) * spacing);
    }
    return start / start.norm();
}

/// Largest eigenvalue of A(Δt), approached from below. Only three vectors are stored. Later vectors lose orthogonality
/// to earlier ones, but this only makes eigenvalues appear repeatedly.
double largest_eigenvalue(const MassScaled& pencil, double dt, const Vector& start, int steps) {
    const Eigen::Index most = std::min<Eigen::Index>(steps, pencil.size());
    Vector diagonal = Vector::Zero(most), beside = Vector::Zero(std::max<Eigen::Index>(most - 1, 0));
    Vector now = start, before = Vector::Zero(pencil.size());
    Eigen::Index done = 0;
    double coupling = 0.0;
    while (done < most) {
        pencil.hear();
        Vector next = pencil.times(2.0 * dt, dt * dt, now);
        const double own = now.dot(next);
        diagonal[done++] = own;
        next -= own * now + coupling * before;
        coupling = next.norm();
        if (done == most || coupling <= 1e-14 * own) break;
        beside[done - 1] = coupling;
        before = std::move(now);
        now = next / coupling;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal.head(done), beside.head(done - 1), Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[done - 1];
}

}  // namespace

double lanczos_step(const MassScaled& pencil, double guess) {
    const Vector start = random_start(pencil.size());
    // λ(Δt) is approximated by aΔt + bΔt² through the last two values found; with only one value, a = 0.
    double dt = guess, last_dt = 0.0, last = 0.0;
    for (int n = 0; n < most_searches; ++n) {
        const double found = largest_eigenvalue(pencil, dt, start, search_steps);
        if (found == 0.0) return std::numeric_limits<double>::infinity();  // no closed contact points
        if (std::abs(found / 4.0 - 1.0) < 0.5 * lanczos_search_error) break;
        double a = 0.0;
        if (n > 0) a = (found / dt * last_dt - last / last_dt * dt) / (last_dt - dt);
        a = std::clamp(a, 0.0, found / dt);
        const double b = (found / dt - a) / dt;
        last_dt = dt, last = found;
        dt = 8.0 / (std::sqrt(a * a + 16.0 * b) + a);
    }
    const double found = largest_eigenvalue(pencil, dt, start, sufficient_steps(pencil.size()));
    return dt * std::min(1.0, 4.0 * (1.0 - lanczos_share) / found);
}

double lanczos_step(const World& world, ClosedPoints which, double guess) {
    return lanczos_step(MassScaled(world, which), guess);
}

bool lanczos_finds_stable(const MassScaled& pencil, double dt) {
    return largest_eigenvalue(pencil, dt, random_start(pencil.size()), sufficient_steps(pencil.size())) <=
           4.0 * (1.0 - lanczos_share);
}

bool lanczos_finds_stable(const World& world, ClosedPoints which, double dt) {
    return lanczos_finds_stable(MassScaled(world, which), dt);
}

}  // namespace crackle
