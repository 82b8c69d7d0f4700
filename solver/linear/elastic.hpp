// SPDX-License-Identifier: GPL-3.0-or-later
// Small-strain solution of a bonded specimen: K u = f from its own bonds and driven bodies, without time stepping.
//
// Every bonded point (every touching one in a world without bonds; or all that touch, where that is asked for) is two
// linear springs, springs.hpp; domain walls are left out. The contact forces are zero after back-tension bonding, so
// the solution is exact for small strain with all bonds intact and sticking.
//
// Floating particles, particles held by one circle contact and other mechanisms make K singular. It is scaled
// by each body's own springs (displacements by their sum k, rotations by k times the square of its bounding radius),
// and a shift of 1e-12 keeps the factorisation (LDLᵀ) going; iterative refinement removes it again from all that
// carries load, and what does not stays where it is. Motions of an energy below 1e-9 of the scaled stiffness count as
// free: the softest mode that carries load has about 1/N, N the particles.
//
// Under the guide's law K is unsymmetric (springs.hpp): solved by LU, as exact; the energy is then the work done along
// a straight way to the solution, and free motions are those of its symmetric part's majorant.
// Tested by tests/verification/claims_test.cpp and tests/solver/linear/stopped_solve_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/linear/springs.hpp"
#include "solver/world/world.hpp"

namespace crackle {

struct Prescribed {
    BodyIndex body;
    /// Its degrees of freedom are held at these values: all three, or, of a body some of whose are driven, those alone.
    BodyMotion motion;
};

struct ElasticSolution {
    std::vector<BodyMotion> displacement;  ///< per body
    std::vector<BodyMotion> reaction;      ///< per entry of `prescribed`: force needed to hold it there
    double energy = 0.0;                   ///< J, ½uᵀKu
    double residual = 0.0;                 ///< |f - Ku| over |f| on the free degrees of freedom, scaled
    /// J, rᵀK⁻¹r of the residual r: a spring of stiffness k is wrong by at most sqrt(this/k) in its stretch, since no
    /// spring takes up more energy than all of them.
    double error_energy = 0.0;
    std::int64_t unknowns = 0;  ///< free degrees of freedom
};

/// @param loads forces (N) and torque (N m) on every body, besides what is prescribed; empty: none
/// @throws InputError if nothing is prescribed, or the refinement does not reach a residual of 1e-9: loads on bodies
/// that nothing holds have no solution.
ElasticSolution solve_elastic(const World& world, const std::vector<Prescribed>& prescribed,
                              const std::vector<BodyMotion>& loads = {}, ClosedPoints closed = ClosedPoints::bonded);

/// Motions without energy of a world whose `held` bodies stay in place, as Prescribed has it.
struct FreeMotions {
    std::int64_t count = 0;         ///< dimension of the null space, by Sylvester's law of inertia
    std::vector<BodyIndex> bodies;  ///< that take part in one
};
FreeMotions find_free_motions(const World& world, const std::vector<BodyIndex>& held,
                              ClosedPoints closed = ClosedPoints::bonded);

}  // namespace crackle
