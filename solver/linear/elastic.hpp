// SPDX-License-Identifier: GPL-3.0-or-later
// Small-strain solution of a bonded specimen: solves K u = f for its bonds and driven bodies, without time stepping.
//
// Each bonded point is represented by two linear springs (springs.hpp); without bonds, or on request, each touching
// point. Domain walls are ignored. Contact forces are zero right after bonding, so the solution is exact for small
// strains as long as all bonds hold without sliding.
//
// K is singular if there are floating particles, particles held by a single circle contact, or other mechanisms. It is
// scaled by each body's own springs (displacements by the sum k of their stiffnesses, rotations by k times the squared
// bounding radius). A diagonal shift of 1e-12 keeps the LDLᵀ factorisation regular. Iterative refinement removes the
// effect of the shift on everything that carries load; bodies that carry no load do not move. Motions whose scaled
// energy is below 1e-9 count as free; the softest mode that carries load has a scaled energy of about 1/N, where N is
// the number of particles.
//
// Under the DEMseg guide's segment law K is unsymmetric (springs.hpp), and the equations are solved by LU to the same
// accuracy. The energy is then the work along a straight path to the solution, and free motions are those of
// symmetric_majorant().
// Tested by tests/verification/claims_test.cpp and tests/solver/linear/stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/springs.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// A body that is held or moved.
struct Prescribed {
    BodyIndex body;
    /// Prescribed motion. It applies to the driven degrees of freedom of the body, or to all three if none is driven.
    BodyMotion motion;
};

/// Displacements, reactions and errors of a linear solution.
struct ElasticSolution {
    std::vector<BodyMotion> displacement;  ///< by body
    std::vector<BodyMotion> reaction;      ///< by entry of `prescribed`: force and torque needed to impose this motion
    double energy = 0.0;                   ///< J, ½uᵀKu
    double residual = 0.0;                 ///< |f - Ku|/|f| on the free degrees of freedom, in scaled units
    /// Energy of the residual, rᵀK⁻¹r, J. It bounds the error: the stretch of a spring of stiffness k is wrong by at
    /// most sqrt(error_energy/k), since no spring stores more than the total energy.
    double error_energy = 0.0;
    std::int64_t unknowns = 0;  ///< number of free degrees of freedom
};

/// Computes displacements and reactions. @param loads force (N) and torque (N m) on every body in addition to the
/// prescribed motions; may be empty
/// @throws InputError if nothing is prescribed, or if refinement does not reach a residual of 1e-9, for example
/// because a load acts on an unsupported body
ElasticSolution solve_elastic(const World& world, const std::vector<Prescribed>& prescribed,
                              const std::vector<BodyMotion>& loads = {}, ClosedPoints closed = ClosedPoints::bonded);

/// Motions that store no energy while some bodies are held in the degrees of freedom to which a Prescribed motion would
/// apply.
struct FreeMotions {
    std::int64_t count = 0;         ///< dimension of the null space, by Sylvester's law of inertia
    std::vector<BodyIndex> bodies;  ///< bodies that move in at least one free motion
};
/// Finds the free motions of a world. @param held bodies that stay in place @param closed points that count as springs
FreeMotions find_free_motions(const World& world, const std::vector<BodyIndex>& held,
                              ClosedPoints closed = ClosedPoints::bonded);

}  // namespace crackle
