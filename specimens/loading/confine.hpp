// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropic stage of a biaxial test: a membrane or walls press the sides, the platens the ends, with the same
// stress.
//
// No time passes. Bodies are moved by linear solutions (Newton's method with the stiffness of the bonded specimen, and
// of what touches the walls): what is left of force on each is a load of the next solution, with the strain between the
// platens that brings their stress to the pressure. It ends where the largest force left on a body is 1e-5 of the
// pressure on a particle's width, on a wall 1e-5 of its force, and the platens' stress is the pressure to 1e-5. Where a
// solution does not halve what is left, for bonds slide or particles roll, steps of motion with kinetic damping follow
// it. Then strains count from there. Walls, and between walls platens that only touch, are first brought to where the
// specimen at rest bears their force.
//
// Tested by tests/specimens/loading/confine_test.cpp.
#pragma once

#include "solver/base/errors.hpp"
#include "specimens/loading/virtual_test.hpp"

namespace crackle {

inline constexpr double most_unbalanced = 1e-5;

/// No equilibrium was found under the pressure; under a lower one there may be.
class PressureRefused : public InputError {
  public:
    using InputError::InputError;
};

/// @param bonded the test's world, or its twin with bonded platens where these only touch: what is solved, but with
/// walls, which press the test's own world alone
/// @param own setup of that world
/// @throws InputError where the specimen does not bear the pressure, PressureRefused where a lower one may help
void confine(VirtualTest& test, const World& bonded, const TestSetup& own);

}  // namespace crackle
