// SPDX-License-Identifier: GPL-3.0-or-later
// What contact kernels are compiled for.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

namespace crackle {

/// What the scene has; absent features cost nothing because a kernel compiled without them is picked.
struct ContactFeatures {
    bool friction = false;  // any law with μ > 0
    bool damping = false;   // any law with a dashpot
    bool bonds = false;
    bool consistent = false;  // first and last steps of contacts by opening.hpp
    bool own_shares = false;  // of stiffness and strength
    bool coulomb = false;     // bonds by coulomb_bond.hpp; these have friction and own_shares, too
    bool own_shear = false;   // shares of shear stiffness, across joints; these have coulomb, too
};

}  // namespace crackle
