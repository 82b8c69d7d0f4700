// SPDX-License-Identifier: GPL-3.0-or-later
// The isotropic stage of a biaxial test: a membrane or walls press on the sides, and the platens on the ends, with
// equal stress.
//
// The stage takes no simulated time. Bodies are moved by linear solutions (Newton's method with the stiffness of the
// bonded specimen and of its contacts with walls). The loads of each solution are the residual forces on the bodies,
// together with the axial strain that makes the platens' stress equal to the pressure. The stage ends when all
// residuals are at most 1e-5:
//   - the largest force on a particle, divided by the pressure times the particle size;
//   - the largest residual force on a wall, divided by the wall's force;
//   - the error of the platens' stress, divided by the pressure.
// If bonds slide or particles roll, a solution may fail to halve the residual; it is then followed by dynamic steps
// with kinetic damping. Strains are measured from the end of the stage. Walls, and with them frictional platens, are
// first moved until the undeformed specimen carries their force.
//
// Tested by tests/specimens/loading/confine_test.cpp.
#pragma once

#include "solver/base/errors.hpp"
#include "specimens/loading/virtual_test.hpp"

namespace crackle {

inline constexpr double most_unbalanced = 1e-5;

/// Thrown if no equilibrium was found under the pressure; there may be one under a lower pressure.
class PressureRefused : public InputError {
  public:
    using InputError::InputError;
};

/// Applies the confining pressure.
/// @param bonded  world used for the linear solutions: the test's own world or, if its platens are not bonded, a copy
/// with bonded platens. With walls, the test's own world is used
/// @param own  test setup with the platens and walls of `bonded`
/// @throws InputError if the specimen cannot carry the pressure; PressureRefused if a lower pressure may work
void confine(VirtualTest& test, const World& bonded, const TestSetup& own);

}  // namespace crackle
