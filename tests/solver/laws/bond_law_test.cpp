// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the functions of a bond law for code outside the kernels: its constants, the state after a break, and failure
// in a linear solution. The bond has k_n = 1e7 N/m and k_s = 2e6 N/m.

#include "solver/laws/bond_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "solver/laws/bond_laws.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::bond_law_test {
namespace {

using testing::agrees;

constexpr double infinite = std::numeric_limits<double>::infinity();

ContactLaw springs() {
    ContactLaw law{};
    law.normal_stiffness = 1e7;
    law.shear_stiffness = 2e6;
    law.friction = 0.5;
    return law;
}

TEST(BondConstants, OfALawHaveOneKeyEachAndAMemberOfItsOwn) {
    std::set<std::string> keys;
    for (const BondConstant& constant : all_bond_constants()) {
        EXPECT_TRUE(keys.insert(constant.key).second) << constant.key;
        BondConstants given;
        given.*constant.given = 1.0;
        EXPECT_NE(given, BondConstants{}) << constant.key;
    }
    EXPECT_EQ(keys, (std::set<std::string>{"tensile_strength", "cohesion", "residual_friction_angle"}));
    EXPECT_EQ(facts_of(BondLaw::back_tension).constant("cohesion"), nullptr);
    const BondConstant* angle = facts_of(BondLaw::coulomb).constant("residual_friction_angle");
    ASSERT_NE(angle, nullptr);
    EXPECT_EQ(angle->spoken(), "residual friction angle");
    EXPECT_TRUE(agrees("tan 45 degrees", angle->in_law(45.0), 1.0, 1e-15));
    EXPECT_EQ(facts_of(BondLaw::coulomb).constant("cohesion")->in_law(45.0), 45.0);
}

TEST(BondLaws, AreNamedByAFactAsMessagesListThem) {
    EXPECT_EQ(laws_with(&BondLawFacts::strengths_are_given), "\"coulomb\" or \"face\"");
    EXPECT_EQ(laws_with(&BondLawFacts::with_guide_segments), "\"back_tension\"");
}

TEST(BondLaws, RefuseATensileStrengthBeyondTheApexOfTheEnvelope) {
    ContactLaw law = springs();
    law.bond_friction = 0.5, law.tensile_strength = 4.0, law.cohesion = 2.0;
    EXPECT_EQ(testing::refusal([&] { check_strengths(law, "x"); }), "accepted") << "at the apex";
    law.tensile_strength = 4.1;
    EXPECT_NE(testing::refusal([&] { check_strengths(law, "x"); }).find("x: found a tensile strength of 4.1 beyond"),
              std::string::npos);
}

/// A bond with an overlap of 3e-6 m at bonding that opens and slips by 1e-7 m in its last step of 1e-3 s.
BondedPoint<double> opened(double overlap) { return {overlap, 3e-6, -1e-4, 1e-4, -4.0, 0.0, 1e-3}; }

TEST(BackTensionBond, ReleasesWhatItsSpringsStoreOnBothSidesOfItsLastStep) {
    const Law<double> law(springs());
    const auto broken = [&](double overlap, const BondMemory& memory) {
        return BackTensionBond::break_bond(law, opened(overlap), memory);
    };
    const double before = 2.9e-6, now = 3e-6;                   // m, openings
    const double shear = 0.5 * 4.0 * (4.0 + 2e6 * 1e-7) / 2e6;  // J
    const BrokenBond torn = broken(0.0, {{-20.0, 30.0}, false, {}});
    EXPECT_TRUE(agrees("energy, J", torn.energy, 0.5e7 * before * now + shear, 1e-12));
    EXPECT_TRUE(agrees("strength k_n δ0, N", torn.strength, 30.0, 1e-14));
    EXPECT_FALSE(torn.in_shear) << "it has not slid";
    EXPECT_EQ(torn.reported.shear, 30.0);
    EXPECT_EQ(torn.rest_overlap, 0.0);
    EXPECT_TRUE(broken(0.0, {{-20.0, 30.0}, true, {}}).in_shear);
    EXPECT_FALSE(broken(0.0, {{-30.0, 20.0}, true, {}}).in_shear);
    EXPECT_TRUE(agrees("with a normal force through 0, J", broken(2.95e-6, {}).energy, shear, 1e-12));
    EXPECT_TRUE(agrees("with known work, J", broken(0.0, {{}, false, 7.0}).energy, 7.0 + shear, 1e-12));
}

TEST(BackTensionBond, BreaksWhereItsOverlapIsGoneAndSlidesAtItsFallingLimit) {
    // Per unit of strain: the overlap falls by 2 mm, and the shear force grows by 1000 N.
    const BondGrowth pulled{{-2e-3, 0.0}, {-2e4, 0.0}, {1e3, 0.0}};
    const ElasticLimits limits = BackTensionBond::elastic_limits(springs(), 3e-6, false, pulled);
    EXPECT_TRUE(agrees("strength, N", limits.strength, 30.0, 1e-14));
    EXPECT_TRUE(agrees("strain at the break", limits.break_strain, 1.5e-3, 1e-12));
    EXPECT_TRUE(agrees("strain at slip, 0.5 (30 - 2e4 ε) = 1e3 ε", limits.slip_strain, 15.0 / 1.1e4, 1e-12));
    EXPECT_EQ(BackTensionBond::elastic_limits(springs(), 3e-6, true, pulled).break_strain, infinite);
    const BondGrowth unsure{{-2e-3, 1e-2}, {-2e4, 3e4}, {1e3, 2e3}};
    EXPECT_EQ(BackTensionBond::elastic_limits(springs(), 3e-6, false, unsure).break_strain, infinite);
    EXPECT_EQ(BackTensionBond::elastic_limits(springs(), 3e-6, false, unsure).slip_strain, infinite);
}

TEST(CoulombBond, FailsInALinearSolutionAtTheFirstOfItsLimits) {
    ContactLaw law = springs();
    law.tensile_strength = 10.0, law.cohesion = 12.0, law.bond_friction = 0.6;
    const auto limits = [&](double normal, double shear) {
        return CoulombBond::elastic_limits(law, 0.0, false, {{}, {normal, 0.0}, {shear, 0.0}});
    };
    EXPECT_TRUE(agrees("pulled", limits(-1e3, 0.0).break_strain, 10.0 / 1e3, 1e-12));
    EXPECT_TRUE(
        agrees("sheared and pressed, 12 + 600 ε = 2000 ε", limits(1e3, 2e3).break_strain, 12.0 / 1400.0, 1e-12));
    EXPECT_EQ(limits(1e3, 500.0).break_strain, infinite) << "friction grows faster than the force";
    EXPECT_EQ(limits(-1e3, 2e3).slip_strain, infinite) << "it never slides";
    EXPECT_EQ(limits(-1e3, 2e3).strength, 10.0);
}

}  // namespace
}  // namespace crackle::bond_law_test
