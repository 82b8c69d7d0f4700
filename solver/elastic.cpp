// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/elastic.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>

#include "solver/errors.hpp"

namespace crackle {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// Far below the softest mode that carries load (about 1/N² of a spring), far above rounding.
constexpr double shift_share = 1e-12;
constexpr double residual_goal = 1e-9;
constexpr int refinements = 20;

/// One spring row: stiffness and the six coefficients (i: x, y, rotation; j: x, y, rotation).
struct Spring {
    BodyIndex i, j;
    double stiffness;
    double coefficient[6];
};

Spring spring_along(const PointView& v, double stiffness, Vec2 d) {
    return {v.body_i, v.body_j, stiffness, {d.x, d.y, cross(v.arm_i, d), -d.x, -d.y, -cross(v.arm_j, d)}};
}

std::vector<Spring> springs_of(const World& world) {
    std::vector<Spring> springs;
    for (PointIndex k = 0; k < world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]; ++k) {
        const PointView view = view_point(world, k);
        if (world.has_bonds ? !view.bonded : !view.touching) continue;
        springs.push_back(spring_along(view, view.normal_stiffness, view.normal));
        if (view.shear_stiffness > 0.0)
            springs.push_back(spring_along(view, view.shear_stiffness, perpendicular(view.normal)));
    }
    return springs;
}

double component(const Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }
double& component(Motion& m, int d) { return d == 0 ? m.x : d == 1 ? m.y : m.rotation; }

double elongation(const Spring& s, const std::vector<Motion>& u) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d)
        sum += s.coefficient[d] * component(u[s.i], d) + s.coefficient[d + 3] * component(u[s.j], d);
    return sum;
}

struct System {
    Matrix stiffness;  // free degrees of freedom, lower triangle
    Vector load;       // from the prescribed motions
};

/// @param number per body and degree of freedom: row of the free system, -1 where prescribed.
System assemble(const std::vector<Spring>& springs, const std::vector<std::array<int, 3>>& number,
                const std::vector<Motion>& held, int rows) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(springs.size() * 21);
    System system;
    system.load = Vector::Zero(rows);
    for (const Spring& s : springs) {
        const double imposed = elongation(s, held);
        for (int a = 0; a < 6; ++a) {
            const int row = number[a < 3 ? s.i : s.j][static_cast<std::size_t>(a % 3)];
            if (row < 0) continue;
            system.load[row] -= s.stiffness * imposed * s.coefficient[a];
            for (int b = 0; b < 6; ++b) {
                const int column = number[b < 3 ? s.i : s.j][static_cast<std::size_t>(b % 3)];
                if (column < 0 || column > row) continue;
                entries.emplace_back(row, column, s.stiffness * s.coefficient[a] * s.coefficient[b]);
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

Vector solve(const System& system, double& residual) {
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor(shifted(system.stiffness));
    if (factor.info() != Eigen::Success)
        throw InputError("elastic solve: the stiffness matrix could not be factorised; is any body bonded?");
    const auto full = system.stiffness.selfadjointView<Eigen::Lower>();
    const double scale = system.load.norm();
    Vector u = factor.solve(system.load);
    Vector rest = system.load - full * u;
    for (int k = 0; k < refinements && rest.norm() > 1e-3 * residual_goal * scale; ++k) {
        const Vector better = u + factor.solve(rest);
        const Vector after = system.load - full * better;
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
        solution.energy += 0.5 * s.stiffness * a * a;
        for (int d = 0; d < 3; ++d) {
            component(force[s.i], d) += s.stiffness * a * s.coefficient[d];
            component(force[s.j], d) += s.stiffness * a * s.coefficient[d + 3];
        }
    }
    for (const Prescribed& p : prescribed) solution.reaction.push_back(force[p.body]);
    return solution;
}

}  // namespace crackle
