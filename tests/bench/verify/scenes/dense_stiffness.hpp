// SPDX-License-Identifier: GPL-3.0-or-later
// Dense stiffness of a bonded world from finite differences of the force routine, independent of how the sparse solve
// assembles its springs. The world must have no damping.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <Eigen/Dense>
#include <cstddef>

#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {

/// Contact forces on all bodies (x, y, moment; N and N m) after one body has moved by `by` along one degree of freedom.
/// The slip of the shear springs is that of a drift of 1 s at the corresponding velocity.
inline Eigen::VectorXd forces_after(const World& start, std::size_t b, int dof, double by) {
    World world = start;
    for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
    world.stepping.drift = 1.0;
    BodyState& body = world.bodies.state[b];
    if (dof == 0) {
        body.x += by;
        body.vx = by;
    } else if (dof == 1) {
        body.y += by;
        body.vy = by;
    } else {
        turn_body(world, b, by);
        body.omega = by;
    }
    world.stepping.forces_current = false;
    compute_forces(world);
    Eigen::VectorXd forces(3 * static_cast<Eigen::Index>(world.bodies.size()));
    for (std::size_t k = 0; k < world.bodies.size(); ++k) {
        const auto row = 3 * static_cast<Eigen::Index>(k);
        forces[row] = world.bodies.force[k].fx;
        forces[row + 1] = world.bodies.force[k].fy;
        forces[row + 2] = world.bodies.force[k].torque;
    }
    return forces;
}

/// K = -∂F/∂u with rows and columns (x, y, rotation) per body, by central differences with Richardson extrapolation.
/// @param move displacement, m; much smaller than the radii of curvature at contacts (discs, thickness at corners)
inline Eigen::MatrixXd dense_stiffness(const World& world, double move) {
    const auto rows = 3 * static_cast<Eigen::Index>(world.bodies.size());
    Eigen::MatrixXd stiffness(rows, rows);
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        for (int dof = 0; dof < 3; ++dof) {
            const double h = dof < 2 ? move : move / world.bodies.info(b).reach;
            const auto slope = [&](double by) -> Eigen::VectorXd {
                return (forces_after(world, b, dof, -by) - forces_after(world, b, dof, by)) / (2.0 * by);
            };
            stiffness.col(3 * static_cast<Eigen::Index>(b) + dof) = (4.0 * slope(0.5 * h) - slope(h)) / 3.0;
        }
    }
    return stiffness;
}

/// Square root of the largest eigenvalue of M^-½ K M^-½, 1/s: without damping, the exact stable step is 2 divided by
/// it.
inline double highest_frequency(const World& world, const Eigen::MatrixXd& stiffness) {
    Eigen::VectorXd root(stiffness.rows());
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const auto row = 3 * static_cast<Eigen::Index>(b);
        root[row] = std::sqrt(world.bodies.inertia[b].inverse_mass_x);
        root[row + 1] = std::sqrt(world.bodies.inertia[b].inverse_mass_y);
        root[row + 2] = std::sqrt(world.bodies.inertia[b].inverse_moment);
    }
    const Eigen::MatrixXd symmetric = 0.5 * (stiffness + stiffness.transpose());
    const Eigen::MatrixXd scaled = root.asDiagonal() * symmetric * root.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace crackle::verification
