// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the compliance of a jointed specimen is given if it is meaningful, together with the theory for persistent
// sets if all traces are persistent.

#include "specimens/elastic/jointed_compliance.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "specimens/case/case_file.hpp"
#include "tests/specimens/joints/cases.hpp"

namespace crackle {
namespace {

std::optional<JointedCompliance> compliance_of_case(const std::string& joints) {
    return jointed_compliance(
        testing::case_of(testing::area_rock + "[mesh]\nkind = \"voronoi\"\nthick = 5e-4\n" + joints), {});
}

TEST(JointedCompliance, OfPersistentTracesIsThatOfTheTheory) {
    const auto found = compliance_of_case(
        "[[joint_set]]\nname = \"level\"\nangle = 0.0\nspacing = 0.125\nthrough = [0.15, 0.0625]\n"
        "normal_stiffness = 2e11\nshear_stiffness = 8e10\n");
    ASSERT_TRUE(found && found->expected) << (found ? found->why_not : "nothing");
    for (std::size_t k = 0; k < 3; ++k) {
        const double got = found->jointed[k][k], wanted = (*found->expected)[k][k];
        fmt::print("  S{0}{0}: expected {1:.6g} 1/Pa, got {2:.6g}, error {3:.2g}; welded {4:.6g}\n", k + 1, wanted, got,
                   got / wanted - 1.0, found->welded[k][k]);
        EXPECT_NEAR(got / wanted, 1.0, 0.01);
    }
    EXPECT_GT(found->jointed[1][1], 1.3 * found->welded[1][1]);
    EXPECT_NEAR((*found->expected)[1][1] - found->welded[1][1], 1.0 / (2e11 * 0.125), 1e-9 / (2e11 * 0.125));
}

// The specimen for comparison has the same flat faces, so the difference is due to the joint alone.
TEST(JointedCompliance, OfCirclesIsThatOfTheTheory) {
    ResolvedCase asked =
        read_case(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/jointed/softrock_welded.toml");
    JointSet& set = asked.joints.sets[0];
    set.directions = OrientationLaw::fixed(0.0);
    set.amount = {AmountKind::spacing, 0.083, LengthLaw::fixed(0.083),
                  Vec2{0.02, 0.0415}};  // m, so that there is one joint, in the middle
    set.mechanics->normal_stiffness = 4e11;
    set.mechanics->shear_stiffness = 1.6e11;
    const auto found = jointed_compliance(asked, {});
    ASSERT_TRUE(found && found->expected) << (found ? found->why_not : "nothing");
    const double ragged = 2.66e-3 / 0.083;  // error due to rows: a diameter divided by the spacing
    for (std::size_t k = 0; k < 3; ++k) {
        const double got = found->jointed[k][k], wanted = (*found->expected)[k][k];
        fmt::print("  S{0}{0}: expected {1:.6g} 1/Pa, got {2:.6g}, error {3:.2g}; welded {4:.6g}\n", k + 1, wanted, got,
                   got / wanted - 1.0, found->welded[k][k]);
        EXPECT_NEAR(got / wanted, 1.0, ragged);
    }
}

TEST(JointedCompliance, OfTracesThatEndHasNoTheoryAndOfNoneIsNone) {
    const auto ends =
        compliance_of_case("[[trace]]\nname = \"crack\"\npoints = [0.05, 0.25, 0.25, 0.25]\nnormal_stiffness = 1e10\n");
    ASSERT_TRUE(ends);
    EXPECT_FALSE(ends->expected);
    EXPECT_EQ(ends->why_not, "the traces of crack end within the box");
    EXPECT_GT(ends->jointed[1][1], 1.02 * ends->welded[1][1]);
    EXPECT_NEAR(ends->jointed[0][0], ends->welded[0][0], 0.02 * ends->welded[0][0]);
    EXPECT_FALSE(compliance_of_case(""));
}

}  // namespace
}  // namespace crackle
