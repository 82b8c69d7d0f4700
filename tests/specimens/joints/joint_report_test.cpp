// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the report of a network: amounts by their definitions, κ recovered from a network, and blocks counted by hand.

#include "specimens/joints/joint_report.hpp"

#include <cmath>
#include <numbers>

#include "specimens/joints/orientation_law.hpp"
#include "tests/specimens/joints/cases.hpp"
#include "tests/support/claim.hpp"

namespace crackle::joint_report_test {
namespace {

using testing::agrees;
using testing::box;
using testing::joints_of;
using testing::within;

constexpr double degree = std::numbers::pi / 180.0;

JointReport report_of(const std::string& text, const Domain& domain) {
    const JointRequest test = joints_of(text);
    return report_joints(test, make_joints(test, domain));
}

TEST(JointReport, TwoCrossingSetsCutRectangles) {
    const JointReport report = report_of(
        "[[joint_set]]\nname = \"a\"\nangle = 0.0\nspacing = 0.25\nthrough = [0.0, 0.125]\n"
        "[[joint_set]]\nname = \"b\"\nangle = 90.0\nspacing = 0.5\nthrough = [0.25, 0.0]\n",
        box(1.0, 1.0));
    EXPECT_EQ(report.blocks, 15U);  // 5 rows of 3 blocks
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

TEST(JointReport, ParallelTracesAreOnePetal) {
    for (int angle = -180; angle < 360; angle += 10) {
        const JointReport report =
            report_of(fmt::format("[[joint_set]]\nname = \"a\"\nangle = {}\nspacing = 0.05\n", angle), box(1.0, 2.0));
        const Rose& rose = report.sources[0].rose;
        const auto bin = static_cast<std::size_t>((angle + 360) % 180 / 10);
        EXPECT_EQ(rose.weights[bin], rose.weight) << angle;
    }
}

/// Report for a set of nearly parallel planes in a section.
SourceReport planes_in(const char* section, double trend, double dip, double dip_direction) {
    return report_of(fmt::format("[joints]\nsection = \"{}\"\nsection_trend = {}\n[[joint_set]]\nname = \"a\"\n"
                                 "orientation = \"fisher\"\ndip = {}\ndip_direction = {}\nfisher_k = 1e6\n"
                                 "length = \"fixed\"\nlength_mean = 0.1\nnumber = 200\n",
                                 section, trend, dip, dip_direction),
                     box(1.0, 1.0))
        .sources[0];
}

// In a vertical section, where +x points to the trend, the apparent dip α of a plane is given by tan α = tan(dip)
// cos(dip direction - trend). On a map its trace is the strike, perpendicular to the dip direction. For K = 1e6, planes
// scatter by 0.06 degrees, and traces by up to this value divided by the sine of the angle between plane and section.
TEST(JointReport, TracesOfPlanesHaveTheirApparentDipInAnySection) {
    for (const double dip_direction : {70.0, 100.0, 250.0}) {
        const double turn = (dip_direction - 40.0) * degree;
        const double apparent = std::atan(std::tan(35.0 * degree) * std::cos(turn)) / degree;
        const SourceReport vertical = planes_in("vertical", 40.0, 35.0, dip_direction);
        EXPECT_TRUE(within("direction asked", vertical.direction_asked, line_direction(-apparent), 1e-9));
        EXPECT_TRUE(within("direction", vertical.direction, line_direction(-apparent), 0.1));
        // Relative to +x, which points to the trend: clockwise by dip direction - trend, plus a quarter turn.
        const double strike = line_direction(90.0 - (dip_direction - 40.0));
        const SourceReport horizontal = planes_in("horizontal", 40.0, 35.0, dip_direction);
        EXPECT_TRUE(within("direction asked, from above", horizontal.direction_asked, strike, 1e-9));
        EXPECT_TRUE(within("direction, from above", horizontal.direction, strike, 0.1));
    }
}

// A box of 2 m by 1.5 m, so that amounts differ from plain numbers. The first trace has its midpoint outside the box,
// which also cuts the second trace.
TEST(JointReport, AmountsOfMeasuredTracesAreThoseCountedByHand) {
    const JointReport report = report_of(
        "[[trace]]\nname = \"out\"\npoints = [1.5, 0.5, 3.5, 0.5]\n"
        "[[trace]]\nname = \"cut\"\npoints = [-0.4, 1.0, 1.0, 1.0]\n"
        "[[trace]]\nname = \"whole\"\npoints = [0.5, 0.2, 0.5, 0.6]\n",
        box(2.0, 1.5));
    EXPECT_EQ(report.sources[0].p20, 0.0);
    EXPECT_TRUE(std::isnan(report.sources[0].mean_length));
    EXPECT_TRUE(agrees("P20 of one", report.sources[1].p20, 1.0 / 3.0, 1e-12));
    EXPECT_TRUE(agrees("its length before the cut", report.sources[1].mean_length, 1.4, 1e-12));
    EXPECT_TRUE(agrees("longest", report.sources[1].longest, 1.0, 1e-12));
    EXPECT_TRUE(agrees("P20", report.all.p20, 2.0 / 3.0, 1e-12));
    EXPECT_TRUE(agrees("mean length", report.all.mean_length, 0.9, 1e-12));
    EXPECT_TRUE(agrees("P21", report.all.p21, 1.9 / 3.0, 1e-12));
    // Their mean direction is 0 degrees, from lengths of 1.5 m and 0.4 m; a line along y crosses the first two.
    EXPECT_TRUE(agrees("scan line", report.all.scan_line, 90.0, 1e-12));
    EXPECT_TRUE(agrees("P10", report.all.p10, 1.5 / 3.0, 1e-12));
    EXPECT_TRUE(agrees("scan line across the third", line_direction(report.sources[2].scan_line + 90.0), 90.0, 1e-12));
    EXPECT_TRUE(agrees("P10 of the third", report.sources[2].p10, 0.4 / 3.0, 1e-12));
}

// Four short traces along x and two long ones at 40 degrees: κ counts each direction once, the mean direction is
// weighted by length.
TEST(JointReport, KappaCountsEachTraceOnce) {
    const double c = std::cos(40.0 * degree), s = std::sin(40.0 * degree);
    const SourceReport all =
        report_of(fmt::format("[[trace]]\npoints = [0.1, 0.1, 0.2, 0.1]\n[[trace]]\npoints = [0.1, 0.3, 0.2, 0.3]\n"
                              "[[trace]]\npoints = [0.1, 0.5, 0.2, 0.5]\n[[trace]]\npoints = [0.1, 0.7, 0.2, 0.7]\n"
                              "[[trace]]\npoints = [0.5, 0.1, {:.17g}, {:.17g}]\n"
                              "[[trace]]\npoints = [0.9, 0.1, {:.17g}, {:.17g}]\n",
                              0.5 + c, 0.1 + s, 0.9 + c, 0.1 + s),
                  box(2.0, 1.5))
            .all;
    const double c2 = std::cos(80.0 * degree), s2 = std::sin(80.0 * degree);  // cosine and sine of the doubled angle
    EXPECT_TRUE(agrees("kappa", all.kappa, fitted_kappa(std::hypot(2.0 + c2, s2) / 3.0, 6), 1e-9));
    EXPECT_TRUE(agrees("direction", all.direction, 0.5 * std::atan2(s2, 0.2 + c2) / degree, 1e-9));
}

TEST(JointReport, AScanLineGivenIsTheOneCounted) {
    const SourceReport a =
        report_of("[[joint_set]]\nname = \"a\"\nangle = 20.0\np10 = 8.0\nscan_line = 50.0\n", box(2.0, 1.5)).sources[0];
    EXPECT_TRUE(agrees("scan line", a.scan_line, 50.0, 1e-12));
    EXPECT_TRUE(agrees("P10 along it", a.p10, 8.0, 1e-9));
    EXPECT_TRUE(agrees("P21, by the angle between", a.p21 * 0.5, 8.0, 1e-9));
    ASSERT_TRUE(a.amount);
    EXPECT_EQ(a.amount->value, 8.0);
    EXPECT_TRUE(agrees("reached", a.amount->reached, 8.0, 1e-9));
}

TEST(JointReport, WithoutAScanLineP10IsThatSquareToTheMean) {
    const SourceReport a =
        report_of("[[joint_set]]\nname = \"a\"\nangle = 20.0\np10 = 8.0\n", box(2.0, 1.5)).sources[0];
    EXPECT_TRUE(agrees("scan line", a.scan_line, 110.0, 1e-12));
    EXPECT_TRUE(agrees("P10", a.p10, 8.0, 1e-9));
    EXPECT_TRUE(agrees("P21 of parallel traces", a.p21, 8.0, 1e-9));
}

TEST(JointReport, GapsTakeTheirShareOfTheFrequencyOfLines) {
    const SourceReport a = report_of(
                               "[[joint_set]]\nname = \"a\"\nangle = 20.0\nlength = \"gaps\"\nlength_mean = 0.3\n"
                               "gap_mean = 0.1\nspacing = 0.02\n",
                               box(10.0, 10.0))
                               .sources[0];
    ASSERT_TRUE(a.amount);
    EXPECT_EQ(a.amount->key, "p10");
    EXPECT_TRUE(agrees("P10 asked", a.amount->value, 0.75 / 0.02, 1e-12));
    // About 600 lines of 25 cycles with random phases: the error at the end of a line is less than a cycle.
    EXPECT_TRUE(agrees("P10", a.p10, 0.75 / 0.02, 0.01));
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
}  // namespace crackle::joint_report_test
