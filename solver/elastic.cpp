// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/elastic.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "solver/errors.hpp"
#include "solver/overlap_gradient.hpp"

namespace crackle {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// Far below the softest mode that carries load (about 1/N² of a spring), far above rounding.
constexpr double shift_share = 1e-12;
constexpr double residual_goal = 1e-9;
constexpr int refinements = 20;

/// One spring: stiffness, the generalised direction it works in and the gradient of its elongation, the same unless the
/// point is under the guide's law (i: x, y, rotation; j: x, y, rotation).
struct Spring {
    BodyIndex i, j;
    double stiffness;
    OverlapGradient push, gradient;
};

Spring spring_along(const PointView& v, double stiffness, Vec2 d) {
    const OverlapGradient row = approach(d, v.arm_i, v.arm_j);
    return {v.body_i, v.body_j, stiffness, row, row};
}

std::vector<Spring> springs_of(const World& world) {
    std::vector<Spring> springs;
    for (PointIndex k = 0; k < world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]; ++k) {
        const PointView view = view_point(world, k);
        if (world.has_bonds ? !view.bonded : !view.touching) continue;
        springs.push_back(spring_along(view, view.normal_stiffness, view.normal));
        springs.back().gradient = view.overlap_gradient;
        if (view.shear_stiffness > 0.0)
            springs.push_back(spring_along(view, view.shear_stiffness, perpendicular(view.normal)));
    }
    return springs;
}

double component(const Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }
double& component(Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }

double times(const Spring& s, const OverlapGradient& row, const std::vector<Motion>& u) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const auto k = static_cast<std::size_t>(d);
        sum += row[k] * component(u[s.i], d) + row[k + 3] * component(u[s.j], d);
    }
    return sum;
}
double elongation(const Spring& s, const std::vector<Motion>& u) { return times(s, s.gradient, u); }

struct System {
    Matrix stiffness;  // free degrees of freedom; lower triangle where it is symmetric
    Vector load;       // from the prescribed motions
    bool symmetric;
};

/// @param number per body and degree of freedom: row of the free system, -1 where prescribed.
System assemble(const std::vector<Spring>& springs, const std::vector<std::array<int, 3>>& number,
                const std::vector<Motion>& held, int rows) {
    std::vector<Eigen::Triplet<double>> entries;
    System system;
    system.symmetric = std::ranges::all_of(springs, [](const Spring& s) { return s.push == s.gradient; });
    entries.reserve(springs.size() * (system.symmetric ? 21 : 36));
    system.load = Vector::Zero(rows);
    for (const Spring& s : springs) {
        const double imposed = elongation(s, held);
        for (std::size_t a = 0; a < 6; ++a) {
            const int row = number[a < 3 ? s.i : s.j][a % 3];
            if (row < 0) continue;
            system.load[row] -= s.stiffness * imposed * s.push[a];
            for (std::size_t b = 0; b < 6; ++b) {
                const int column = number[b < 3 ? s.i : s.j][b % 3];
                if (column < 0 || (system.symmetric && column > row)) continue;
                entries.emplace_back(row, column, s.stiffness * s.push[a] * s.gradient[b]);
            }
        }
    }
    system.stiffness.resize(rows, rows);
    system.stiffness.setFromTriplets(entries.begin(), entries.end());
    return system;
}

/// K with a shifted diagonal, so that loose degrees of freedom do not stop the factorisation.
Matrix shifted(const Matrix& stiffness) {
    double largest = 0.0;
    for (Eigen::Index k = 0; k < stiffness.rows(); ++k) largest = std::max(largest, stiffness.coeff(k, k));
    Matrix identity(stiffness.rows(), stiffness.rows());
    identity.setIdentity();
    return stiffness + (shift_share * largest) * identity;
}

/// @param full K as it acts on a vector
template <typename Factor, typename Full>
Vector refine(const Factor& factor, const Full& full, const Vector& load, double& residual) {
    if (factor.info() != Eigen::Success)
        throw InputError("elastic solve: the stiffness matrix could not be factorised; is any body bonded?");
    const double scale = load.norm();
    Vector u = factor.solve(load);
    Vector rest = load - full * u;
    for (int k = 0; k < refinements && rest.norm() > 1e-3 * residual_goal * scale; ++k) {
        const Vector better = u + factor.solve(rest);
        const Vector after = load - full * better;
        if (!(after.norm() < rest.norm())) break;
        u = better;
        rest = after;
    }
    residual = scale > 0.0 ? rest.norm() / scale : 0.0;
    if (!(residual <= residual_goal)) {
        throw InputError(
            fmt::format("elastic solve: found a residual of {:.3g}, expected at most {:.3g}; the specimen's stiffness "
                        "is too ill-conditioned",
                        residual, residual_goal));
    }
    return u;
}

Vector solve(const System& system, double& residual) {
    if (system.symmetric) {
        const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor(shifted(system.stiffness));
        return refine(factor, system.stiffness.selfadjointView<Eigen::Lower>(), system.load, residual);
    }
    Matrix matrix = shifted(system.stiffness);
    matrix.makeCompressed();
    const Eigen::SparseLU<Matrix> factor(matrix);
    return refine(factor, system.stiffness, system.load, residual);
}

}  // namespace

ElasticSolution solve_elastic(const World& world, const std::vector<Prescribed>& prescribed) {
    if (prescribed.empty()) throw InputError("elastic solve: found no prescribed body, expected at least one platen");
    ElasticSolution solution;
    solution.displacement.assign(world.bodies.size(), Motion{});
    std::vector<std::array<int, 3>> number(world.bodies.size(), {0, 0, 0});
    for (const Prescribed& p : prescribed) {
        number[p.body] = {-1, -1, -1};
        solution.displacement[p.body] = p.motion;
    }
    int rows = 0;
    for (auto& dofs : number) {
        for (int& dof : dofs) dof = dof < 0 ? -1 : rows++;
    }
    const std::vector<Spring> springs = springs_of(world);
    const Vector u =
        rows > 0 ? solve(assemble(springs, number, solution.displacement, rows), solution.residual) : Vector();
    for (std::size_t b = 0; b < number.size(); ++b) {
        for (int d = 0; d < 3; ++d) {
            const int row = number[b][static_cast<std::size_t>(d)];
            if (row >= 0) component(solution.displacement[b], d) = u[row];
        }
    }
    std::vector<Motion> force(world.bodies.size());
    for (const Spring& s : springs) {
        const double a = elongation(s, solution.displacement);
        solution.energy += 0.5 * s.stiffness * a * times(s, s.push, solution.displacement);
        for (int d = 0; d < 3; ++d) {
            const auto k = static_cast<std::size_t>(d);
            component(force[s.i], d) += s.stiffness * a * s.push[k];
            component(force[s.j], d) += s.stiffness * a * s.push[k + 3];
        }
    }
    for (const Prescribed& p : prescribed) solution.reaction.push_back(force[p.body]);
    return solution;
}

}  // namespace crackle
