// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a network: amounts by their definitions, κ recovered from a network, and blocks that can be counted by
// hand.

#include "specimens/joints/joint_report.hpp"

#include <cmath>

#include "tests/specimens/joints/cases.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::box;
using testing::joints_of;
using testing::within;

JointReport report_of(const std::string& text, const Domain& domain) {
    const TestCase test = joints_of(text);
    return report_joints(test, make_joints(test, domain));
}

TEST(JointReport, TwoCrossingSetsCutRectangles) {
    const JointReport report = report_of(
        "[[joint_set]]\nname = \"a\"\nangle = 0.0\nspacing = 0.25\nthrough = [0.0, 0.125]\n"
        "[[joint_set]]\nname = \"b\"\nangle = 90.0\nspacing = 0.5\nthrough = [0.25, 0.0]\n",
        box(1.0, 1.0));
    EXPECT_EQ(report.blocks, 15U);  // 5 rows of 3
    EXPECT_TRUE(agrees("largest", report.largest_block, 0.25 * 0.5, 1e-12));
    EXPECT_TRUE(agrees("P21 of a", report.sources[0].p21, 4.0, 1e-12));
    EXPECT_TRUE(agrees("P10 of b", report.sources[1].p10, 2.0, 1e-12));
    EXPECT_TRUE(agrees("P21 of all", report.all.p21, 6.0, 1e-12));
    EXPECT_TRUE(within("direction of a", report.sources[0].direction, 0.0, 1e-9));
    EXPECT_TRUE(agrees("direction of b", report.sources[1].direction, 90.0, 1e-9));
    EXPECT_TRUE(std::isinf(report.sources[0].kappa));
    EXPECT_TRUE(std::isnan(report.sources[0].p20));
}

TEST(JointReport, BlocksOfTooManyCrossingsAreNotCountedAndTheRestIsReported) {
    const JointReport report = report_of(
        "[[joint_set]]\nname = \"a\"\nangle = 0.0\nspacing = 4e-4\n"
        "[[joint_set]]\nname = \"b\"\nangle = 90.0\nspacing = 4e-4\n",
        box(1.0, 1.0));
    EXPECT_FALSE(report.blocks);
    EXPECT_TRUE(std::isnan(report.largest_block));
    ASSERT_EQ(report.notices.size(), 1U);
    EXPECT_TRUE(report.notices[0].starts_with("blocks are not counted: found more than")) << report.notices[0];
    EXPECT_TRUE(agrees("P10 of a", report.sources[0].p10, 2500.0, 1e-9));
}

TEST(JointReport, TracesThatEndInTheRockCutNothing) {
    const JointReport report =
        report_of("[[trace]]\npoints = [0.2, 0.2, 0.8, 0.3, 0.7, 0.9]\n[[trace]]\npoints = [0.0, 0.5, 0.6, 0.5]\n",
                  box(1.0, 1.0));
    EXPECT_EQ(report.blocks, 1U);
    EXPECT_EQ(report.largest_block, 1.0);
    EXPECT_EQ(report.all.traces, 2U);
}

TEST(JointReport, AnIslandIsABlockOfItsOwn) {
    const JointReport report =
        report_of("[[trace]]\npoints = [0.2, 0.2, 0.8, 0.2, 0.8, 0.7, 0.2, 0.7, 0.2, 0.2]\n", box(1.0, 1.0));
    EXPECT_EQ(report.blocks, 2U);
    EXPECT_TRUE(agrees("around it", report.largest_block, 0.7, 1e-12));
    EXPECT_TRUE(agrees("itself", report.median_block, 0.3, 1e-12));
}

TEST(JointReport, AnEndWithinTheDigitsOfASurveyMeetsTheOtherTrace) {
    const JointReport report = report_of(
        "[[trace]]\npoints = [0.0, 0.5, 1.0, 0.5]\n[[trace]]\npoints = [0.4, 0.0, 0.4, 0.49995]\n", box(1.0, 1.0));
    EXPECT_EQ(report.blocks, 3U);
}

TEST(JointReport, KappaAndMeanLengthOfANetworkAreRecovered) {
    const JointReport report = report_of(
        "[[joint_set]]\nname = \"a\"\norientation = \"von_mises\"\nangle = 60.0\nkappa = 12.0\nlength = \"lognormal\"\n"
        "length_mean = 0.02\nlength_deviation = 0.01\nnumber = 5000\n",
        box(2.0, 1.0));
    const SourceReport& a = report.sources[0];
    EXPECT_TRUE(agrees("kappa", a.kappa, 12.0, 4.0 * std::sqrt(2.0 / 5000)));
    EXPECT_TRUE(agrees("mean length", a.mean_length, 0.02, 4.0 * 0.5 / std::sqrt(5000.0)));
    EXPECT_TRUE(within("direction", a.direction, 60.0, 1.0));
    EXPECT_EQ(a.kappa_asked, 12.0);
    EXPECT_TRUE(agrees("length asked", a.mean_length_asked, 0.02, 1e-12));
    ASSERT_TRUE(a.amount);
    EXPECT_EQ(a.amount->key, "number");
    EXPECT_EQ(a.amount->reached, 5000.0);
}

}  // namespace
}  // namespace crackle
