// SPDX-License-Identifier: GPL-3.0-or-later
// Small-strain solution of a bonded specimen: K u = f from its own bonds and driven bodies, without time stepping.
//
// Every bonded point (every touching one in a world without bonds) contributes ½k_n a_n² + ½k_s a_t², with
//     a_n = n·(u_i - u_j) + (r_i × n) θ_i - (r_j × n) θ_j          and a_t with the tangent t for n,
// linearised about the present positions: the contact forces there are zero after back-tension bonding, so there is no
// geometric stiffness, and the solution is exact for small strain with all bonds intact and sticking. Under the guide's
// law a point pushes along a_n while its overlap answers to g·u (PointView::overlap_gradient): K = Σ k_n a gᵀ + … is
// then unsymmetric, the solution as exact, and the energy the work done along a straight way to it.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/world.hpp"

namespace crackle {

/// Displacement and rotation of a body, m and rad; or force and moment on it, N and N m.
struct Motion {
    double x = 0.0, y = 0.0, rotation = 0.0;
};

struct Prescribed {
    BodyIndex body;
    Motion motion;  ///< all three degrees of freedom are held at these values
};

struct ElasticSolution {
    std::vector<Motion> displacement;  ///< per body
    std::vector<Motion> reaction;      ///< per entry of `prescribed`: force needed to hold it there
    double energy = 0.0;               ///< J, ½uᵀKu
    double residual = 0.0;             ///< |f - Ku| over |f| on the free degrees of freedom
};

/// Sparse Cholesky (Eigen's LDLᵀ; LU where K is unsymmetric). Degrees of freedom without stiffness (floating circles,
/// circles hanging on one contact) are held by a diagonal shift of 1e-12 that iterative refinement removes from
/// everything that does carry load.
/// @throws InputError if nothing is prescribed, or the refinement does not reach a residual of 1e-9.
ElasticSolution solve_elastic(const World& world, const std::vector<Prescribed>& prescribed);

}  // namespace crackle
