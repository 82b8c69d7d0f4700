// SPDX-License-Identifier: GPL-3.0-or-later
// Tests where a specimen separated, for cracks set by hand in a chain of particles between two platens.

#include "specimens/measures/parting.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

/// Particles 0 to 9 at heights 0.05, 0.15, ... of a specimen of 1 m height that begins at y = 2; platens are 10 and 11.
/// Bond n joins particles n and n + 1; bonds 9 and 10 join the lower platen with particles 0 and 1, and bond 11 belongs
/// to the upper platen.
TestSetup chain(double grip) {
    TestSetup setup;
    setup.specimen.height = 1.0;
    setup.specimen.low_end = 2.0;
    setup.bonds.grip = grip;
    setup.apparatus.bottom = 10;
    setup.apparatus.top = 11;
    setup.apparatus.parts = {{10, 2}, {11, 2}};
    for (int k = 0; k < 10; ++k) setup.bonds.start.push_back({0.0, 2.05 + 0.1 * k, 0.0});
    setup.bonds.start.push_back({0.0, 1.9, 0.0});
    setup.bonds.start.push_back({0.0, 3.1, 0.0});
    const auto bond = [&](BodyIndex i, BodyIndex j) {
        setup.bonds.points.push_back(PointKind::circle_circle, {i, j, own_circle, own_circle});
    };
    for (BodyIndex k = 0; k < 9; ++k) bond(k, k + 1);
    bond(0, 10);
    bond(1, 10);
    bond(9, 11);
    return setup;
}

ContactHistory broken(std::initializer_list<PointIndex> bonds) {
    ContactHistory history;
    for (const PointIndex bond : bonds) {
        Crack crack;
        crack.bond = bond;
        history.cracks.push_back(crack);
    }
    return history;
}

TEST(Parting, OfNoBrokenBondIsNowhere) { EXPECT_FALSE(find_parting(chain(0.1), broken({}))); }

TEST(Parting, IsOfTheLargestCrackWhichIsBrokenBondsThatShareParticles) {
    // Bonds 3 and 4 share particle 4; bonds 0 and 8 are isolated.
    const std::optional<Parting> parting = find_parting(chain(0.1), broken({0, 3, 8, 4}));
    ASSERT_TRUE(parting);
    EXPECT_EQ(parting->bonds, 2);
    EXPECT_EQ(parting->place, PartingPlace::gauge);
    EXPECT_NEAR(parting->height, 0.45, 1e-12);  // mean of 0.40 and 0.50
}

TEST(Parting, WithinTheDepthOfAGripIsTheGrips) {
    EXPECT_EQ(find_parting(chain(0.15), broken({0}))->place, PartingPlace::grip);  // at 0.10
    EXPECT_EQ(find_parting(chain(0.15), broken({8}))->place, PartingPlace::grip);  // at 0.90
    EXPECT_EQ(find_parting(chain(0.05), broken({0}))->place, PartingPlace::gauge);
}

TEST(Parting, HalfOfWhoseBondsAreAPlatensIsThePlatens) {
    // Both bonds of the lower platen, and one between particles 1 and 2: two of three are at the platen.
    const Parting parting = *find_parting(chain(0.1), broken({9, 10, 1}));
    EXPECT_EQ(parting.place, PartingPlace::platen);
    EXPECT_EQ(parting.bonds, 3);
    EXPECT_EQ(parting.of_platen, 2);
    EXPECT_NEAR(parting.height, (0.05 + 0.15 + 0.20) / 3.0, 1e-12);
    EXPECT_EQ(find_parting(chain(0.0), broken({11, 8}))->place, PartingPlace::platen) << "half";
    EXPECT_EQ(find_parting(chain(0.0), broken({11, 8, 7}))->place, PartingPlace::gauge) << "a third";
}

}  // namespace
}  // namespace crackle
