// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the bound on the stable step of a triangular lattice against its derivation. Closed forms of lattices and
// chains are in tests/bench/verify.

#include <algorithm>
#include <cmath>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace crackle::lattice_test {
namespace {

constexpr double radius = 0.02, overlap = 8e-5, kn = 1e7;

TEST(TriangularLattice, BoundOfTheStepComesFromDoubledBlocks) {
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        World world = build_world(triangular_lattice(14, 15, radius, overlap, verification::rock(45.0, share)));
        bond_all(world, 0.0);
        // Blocks of a disc with six neighbours, multiplied by two: 6(k_n + k_s) for displacement, 24 k_s for rotation.
        const double ks = share * kn, lever = 1.0 - overlap / (2.0 * radius);
        const double doubled =
            2.0 * std::sqrt(world.bodies.inertia[0].mass / std::max(6.0 * (kn + ks), 24.0 * ks * lever * lever));
        EXPECT_TRUE(testing::agrees("bound from doubled blocks", world.stepping.step_bound, doubled, 1e-8));
    }
}

}  // namespace
}  // namespace crackle::lattice_test
