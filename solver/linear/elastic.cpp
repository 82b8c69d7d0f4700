// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/elastic.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "solver/base/errors.hpp"
#include "solver/linear/face_rows.hpp"

namespace crackle {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Factor = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

// Diagonal shift, and energy below which a motion counts as free, in scaled units. Both are far below the energy of the
// softest mode that carries load, and far above round-off.
constexpr double shift = 1e-12;
constexpr double free_energy = 1e-9;
constexpr double residual_goal = 1e-9;
constexpr int refinements = 20;
// Number of random vectors that are projected onto the free motions. Only by coincidence can they all miss a body that
// takes part in a free motion.
constexpr int probes = 3;
constexpr double taking_part = 1e-6;

/// For each degree of freedom, three per body, whether it is held.
std::vector<bool> held_freedoms(const World& world, const std::vector<BodyIndex>& bodies) {
    std::vector<bool> held(3 * world.bodies.size(), false);
    for (const BodyIndex b : bodies) {
        const BodyInertia& inertia = world.bodies.inertia[b];
        const std::array<double, 3> inverse{inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_moment};
        const bool driven = std::ranges::any_of(inverse, [](double one) { return one == 0.0; });
        for (std::size_t d = 0; d < 3; ++d) held[3 * std::size_t{b} + d] = !driven || inverse[d] == 0.0;
    }
    return held;
}

std::vector<Spring> springs_between_bodies(const World& world, ClosedPoints closed) {
    std::vector<Spring> springs = springs_of(world, closed);
    std::erase_if(springs, [](const Spring& s) { return s.j == no_body; });
    return springs;
}

/// The free degrees of freedom and their stiffness matrix, scaled by each body's own springs so that entries are at
/// most 1.
class ScaledSystem {
  public:
    ScaledSystem(const World& world, const std::vector<Spring>& springs, const LinearRows& rows,
                 const std::vector<bool>& held) {
        number_.assign(held.size(), -1);
        int size = 0;
        for (std::size_t k = 0; k < held.size(); ++k)
            if (!held[k]) number_[k] = size++;
        // Diagonal entries are not used for scaling: for the rotation of a frictionless disc this entry is only
        // round-off, and scaling by it would make it look like stiffness.
        std::vector<double> stiffness(world.bodies.size(), 0.0);
        for (const Spring& s : springs) {
            stiffness[s.i] += s.stiffness;
            stiffness[s.j] += s.stiffness;
        }
        for (const LinearRow& row : rows.rows)
            for (const RowEntry& entry : rows.of(row))
                if (entry.freedom < 2) stiffness[entry.body] += row.stiffness * entry.value * entry.value;
        scale_ = Vector::Ones(size);
        for (std::size_t b = 0; b < stiffness.size(); ++b) {
            if (stiffness[b] == 0.0) continue;
            const double root = std::sqrt(stiffness[b]);
            for (int d = 0; d < 3; ++d)
                if (number(b, d) >= 0)
                    scale_[number(b, d)] = d < 2 ? 1.0 / root : 1.0 / (root * world.bodies.info(b).reach);
        }
        assemble(springs, rows, size);
    }

    int number(const Spring& s, std::size_t a) const { return number_[3 * std::size_t{a < 3 ? s.i : s.j} + a % 3]; }
    int number(std::size_t body, int dof) const { return number_[3 * body + static_cast<std::size_t>(dof)]; }
    double scale(int row) const { return scale_[row]; }
    bool symmetric() const { return symmetric_; }
    const Matrix& stiffness() const { return stiffness_; }  // lower triangle if symmetric
    Matrix shifted(double by) const {
        Matrix identity(stiffness_.rows(), stiffness_.rows());
        identity.setIdentity();
        return stiffness_ + by * identity;
    }

  private:
    void assemble(const std::vector<Spring>& springs, const LinearRows& rows, int size) {
        symmetric_ = std::ranges::all_of(springs, &Spring::symmetric);
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(springs.size() * (symmetric_ ? 21 : 36));
        for (const Spring& s : springs) {
            for (std::size_t a = 0; a < 6; ++a) {
                const int row = number(s, a);
                if (row < 0) continue;
                for (std::size_t b = 0; b < 6; ++b) {
                    const int column = number(s, b);
                    if (column < 0 || (symmetric_ && column > row)) continue;
                    entries.emplace_back(row, column,
                                         s.stiffness * s.push[a] * scale_[row] * s.gradient[b] * scale_[column]);
                }
            }
        }
        for (const LinearRow& own : rows.rows) {
            for (const RowEntry& a : rows.of(own)) {
                const int row = number(a.body, a.freedom);
                if (row < 0) continue;
                for (const RowEntry& b : rows.of(own)) {
                    const int column = number(b.body, b.freedom);
                    if (column < 0 || (symmetric_ && column > row)) continue;
                    entries.emplace_back(row, column, own.stiffness * a.value * scale_[row] * b.value * scale_[column]);
                }
            }
        }
        stiffness_.resize(size, size);
        stiffness_.setFromTriplets(entries.begin(), entries.end());
    }

    std::vector<int> number_;  // row index by body and degree of freedom; -1 if held
    Vector scale_;             // for each row, displacement per unit of the scaled unknown
    Matrix stiffness_;
    bool symmetric_ = true;
};

template <class Solver>
void require_factor(const Solver& factor) {
    if (factor.info() != Eigen::Success)
        throw InputError("elastic solve: the stiffness matrix could not be factorised; is any body bonded?");
}

struct Refined {
    Vector u;
    double residual = 0.0;
    double error_energy = 0.0;
};

/// Solves by the given factorisation and then refines the solution. @param full matrix K, including its upper triangle
template <class Solver, class Full>
Refined refine(const Workers& workers, const Solver& factor, const Full& full, const Vector& load) {
    require_factor(factor);
    workers.hear();
    const double size = load.norm();
    Vector u = factor.solve(load);
    Vector rest = load - full * u;
    for (int k = 0; k < refinements && rest.norm() > 1e-3 * residual_goal * size; ++k) {
        workers.hear();
        const Vector better = u + factor.solve(rest);
        const Vector after = load - full * better;
        if (!(after.norm() < rest.norm())) break;
        u = better;
        rest = after;
    }
    const double residual = size > 0.0 ? rest.norm() / size : 0.0;
    if (!(residual <= residual_goal)) {
        throw InputError(
            fmt::format("elastic solve: found a residual of {:.3g}, expected at most {:.3g}, because the stiffness "
                        "matrix is too ill-conditioned; check that every part of the specimen is held, for example "
                        "blocks between frictionless joints",
                        residual, residual_goal));
    }
    return {u, residual, std::abs(rest.dot(factor.solve(rest)))};
}

Refined solve(const Workers& workers, const ScaledSystem& system, const Vector& load) {
    const Matrix& stiffness = system.stiffness();
    workers.hear();
    if (system.symmetric()) {
        const Factor factor(system.shifted(shift));
        return refine(workers, factor, stiffness.selfadjointView<Eigen::Lower>(), load);
    }
    Eigen::SparseLU<Matrix> factor;
    factor.compute(system.shifted(shift));
    return refine(workers, factor, stiffness, load);
}

/// Right-hand side for the free degrees of freedom: the loads minus the forces due to the prescribed motions.
Vector load_of(const ScaledSystem& system, const std::vector<Spring>& springs, const LinearRows& rows,
               const std::vector<BodyMotion>& prescribed, const std::vector<BodyMotion>& loads) {
    Vector load = Vector::Zero(system.stiffness().rows());
    for (const Spring& s : springs) {
        const double imposed = times(s, s.gradient, prescribed);
        for (std::size_t a = 0; a < 6; ++a) {
            const int row = system.number(s, a);
            if (row >= 0) load[row] -= s.stiffness * imposed * s.push[a] * system.scale(row);
        }
    }
    for (const LinearRow& own : rows.rows) {
        const double imposed = rows.times(own, prescribed);
        for (const RowEntry& entry : rows.of(own)) {
            const int row = system.number(entry.body, entry.freedom);
            if (row >= 0) load[row] -= own.stiffness * imposed * entry.value * system.scale(row);
        }
    }
    for (std::size_t b = 0; b < loads.size(); ++b) {
        const double force[3] = {loads[b].x, loads[b].y, loads[b].rotation};
        for (int d = 0; d < 3; ++d) {
            const int row = system.number(b, d);
            if (row >= 0) load[row] += force[d] * system.scale(row);
        }
    }
    return load;
}

/// Adds the energy of a solution, and returns the force on each body.
std::vector<BodyMotion> forces_of(ElasticSolution& solution, const std::vector<Spring>& springs,
                                  const LinearRows& rows) {
    std::vector<BodyMotion> force(solution.displacement.size());
    for (const Spring& s : springs) {
        const double a = times(s, s.gradient, solution.displacement);
        solution.energy += 0.5 * s.stiffness * a * times(s, s.push, solution.displacement);
        for (int d = 0; d < 3; ++d) {
            const auto k = static_cast<std::size_t>(d);
            component(force[s.i], d) += s.stiffness * a * s.push[k];
            component(force[s.j], d) += s.stiffness * a * s.push[k + 3];
        }
    }
    for (const LinearRow& own : rows.rows) {
        const double a = rows.times(own, solution.displacement);
        solution.energy += 0.5 * own.stiffness * a * a;
        for (const RowEntry& entry : rows.of(own))
            component(force[entry.body], entry.freedom) += own.stiffness * a * entry.value;
    }
    return force;
}

}  // namespace

ElasticSolution solve_elastic(const World& world, const std::vector<Prescribed>& prescribed,
                              const std::vector<BodyMotion>& loads, ClosedPoints closed) {
    if (prescribed.empty())
        throw InputError("elastic solve: found no body with a prescribed motion, expected at least one platen");
    ElasticSolution solution;
    solution.displacement.assign(world.bodies.size(), BodyMotion{});
    std::vector<BodyIndex> bodies;
    bodies.reserve(prescribed.size());
    for (const Prescribed& p : prescribed) bodies.push_back(p.body);
    const std::vector<bool> held = held_freedoms(world, bodies);
    for (const Prescribed& p : prescribed)
        for (int d = 0; d < 3; ++d)
            if (held[3 * std::size_t{p.body} + static_cast<std::size_t>(d)])
                component(solution.displacement[p.body], d) = component(p.motion, d);
    const std::vector<Spring> springs = springs_between_bodies(world, closed);
    const LinearRows rows = face_rows(world, FacesWithRows::intact);
    const ScaledSystem system(world, springs, rows, held);
    solution.unknowns = system.stiffness().rows();
    if (solution.unknowns > 0) {
        const Refined refined =
            solve(world.workers, system, load_of(system, springs, rows, solution.displacement, loads));
        const Vector& u = refined.u;
        solution.residual = refined.residual;
        solution.error_energy = refined.error_energy;
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            for (int d = 0; d < 3; ++d) {
                const int row = system.number(b, d);
                if (row >= 0) component(solution.displacement[b], d) = u[row] * system.scale(row);
            }
        }
    }
    const std::vector<BodyMotion> force = forces_of(solution, springs, rows);
    for (const Prescribed& p : prescribed) solution.reaction.push_back(force[p.body]);
    return solution;
}

FreeMotions find_free_motions(const World& world, const std::vector<BodyIndex>& held_bodies, ClosedPoints closed) {
    const std::vector<bool> held = held_freedoms(world, held_bodies);
    const ScaledSystem system(world, symmetric_majorant(world, springs_between_bodies(world, closed)),
                              face_rows(world, FacesWithRows::intact), held);
    FreeMotions free;
    if (system.stiffness().rows() == 0) return free;
    world.workers.hear();
    Factor factor(system.shifted(-free_energy));
    require_factor(factor);
    free.count = (factor.vectorD().array() < 0.0).count();
    if (free.count == 0) return free;
    world.workers.hear();
    factor.compute(system.shifted(shift));
    require_factor(factor);
    std::vector<bool> takes_part(world.bodies.size(), false);
    std::minstd_rand random(1);
    for (int n = 0; n < probes; ++n) {
        world.workers.hear();
        Vector z(system.stiffness().rows());
        for (double& value : z) value = 2.0 * static_cast<double>(random()) / std::minstd_rand::max() - 1.0;
        z = shift *
            factor.solve(
                z);  // keeps motions without energy and multiplies others by 1e-12 divided by their scaled energy
        z = shift * factor.solve(z);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            for (int d = 0; d < 3; ++d) {
                const int row = system.number(b, d);
                if (row >= 0 && std::abs(z[row]) > taking_part) takes_part[b] = true;
            }
        }
    }
    for (std::size_t b = 0; b < takes_part.size(); ++b) {
        if (takes_part[b]) free.bodies.push_back(static_cast<BodyIndex>(b));
    }
    return free;
}

}  // namespace crackle
