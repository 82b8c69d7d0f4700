// SPDX-License-Identifier: GPL-3.0-or-later
// What the contacts of a scene have. Kernels ask `has.friction` of a set of features: of a ContactFeatures while they
// run, of a CompiledFeatures when they are compiled, which drops what is absent.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

namespace crackle {

struct ContactFeatures {
    bool friction = false;  // any law with μ > 0
    bool damping = false;   // any law with a dashpot
    bool bonds = false;
    bool consistent = false;  // first and last steps of contacts by opening.hpp
    bool own_shares = false;  // of stiffness and strength
    bool coulomb = false;     // bonds by coulomb_bond.hpp; these have friction and own_shares, too
    bool own_shear = false;   // shares of shear stiffness, across joints; these have coulomb, too

    friend constexpr bool operator==(const ContactFeatures&, const ContactFeatures&) = default;
};

template <ContactFeatures F>
struct CompiledFeatures {
    explicit CompiledFeatures(const ContactFeatures&) {}
    static constexpr bool friction = F.friction, damping = F.damping, bonds = F.bonds, consistent = F.consistent,
                          own_shares = F.own_shares, coulomb = F.coulomb, own_shear = F.own_shear;
};

}  // namespace crackle
