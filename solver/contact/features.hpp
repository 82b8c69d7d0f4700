// SPDX-License-Identifier: GPL-3.0-or-later
// Features that the contacts of a scene use. Kernels query them through a parameter, for example `has.friction`.
// With FeaturesOf, features are tested at run time. With CompiledFeatures, they are tested at compile time, and the
// compiler removes unused code (kernels.cpp).
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include "solver/laws/bond_law.hpp"

namespace crackle {

/// Features that the contact points of a scene need. The kernels for common sets contain only the code for these
/// features.
struct ContactFeatures {
    bool friction = false;  // whether any law has μ > 0
    bool damping = false;   // whether any law has a dashpot
    bool bonds = false;
    bool consistent = false;  // whether the consistent integrator is used (opening.hpp)
    bool own_shares = false;  // whether each point has its own stiffness and strength factors
    bool own_shear = false;   // whether points across joints have their own shear stiffness factor
    BondLaw bond_law{};       // law of the bonds; the first enumerator if there are no bonds

    friend constexpr bool operator==(const ContactFeatures&, const ContactFeatures&) = default;
};

}  // namespace crackle
