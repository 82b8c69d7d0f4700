// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the rows made from a plan, and what is refused.

#include "specimens/campaign/plan_file.hpp"
#include "specimens/kinds/test_kind.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

using testing::write_packed_case;
using testing::write_small_plan;
using testing::write_text;

class PlanTest : public ::testing::Test {
  protected:
    Plan plan_of(const std::string& text, bool companions = false) const {
        write_packed_case(folder_ / "tension.toml");
        write_text(folder_ / "plan.toml", text);
        return read_plan(folder_ / "plan.toml", companions);
    }
    void expect_refused(const std::string& text, const std::string& says) const {
        const std::string said = testing::refusal([&] { plan_of(text); });
        EXPECT_NE(said.find(says), std::string::npos) << said << "\nof: " << text;
    }

    testing::ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";
    const std::string test_ = "[[test]]\ncase = \"tension.toml\"\n";
};

TEST_F(PlanTest, HasEveryCombinationWithEveryPacking) {
    const Plan plan = read_plan(write_small_plan(folder_, 3));
    ASSERT_EQ(plan.points.size(), 4U) << "two tests at two values";
    ASSERT_EQ(plan.rows.size(), 12U);
    for (std::size_t k = 0; k < plan.rows.size(); ++k) EXPECT_EQ(plan.rows[k].seed, 1 + static_cast<int>(k) / 4);
    const ResolvedCase last = plan.test_of(plan.rows.back());
    EXPECT_EQ(last.loading.kind, LoadingKind::compression);
    EXPECT_EQ(last.material.friction_angle, 35.0);
    EXPECT_EQ(last.packing()->seed, 3);
    EXPECT_EQ(plan.test_of(plan.rows[0]).material.friction_angle, 20.0);
}

TEST_F(PlanTest, AnAxisOfOneTestLeavesTheOthersAlone) {
    write_packed_case(folder_ / "compression.toml", "compression");
    const Plan plan = plan_of(test_ +
                              "[[test]]\ncase = \"compression.toml\"\nname = \"squeezed\"\n"
                              "[[axis]]\nkey = \"loading.max_axial_strain\"\nvalues = [1e-3, 2e-3, 3e-3]\n"
                              "tests = [\"squeezed\"]\n");
    ASSERT_EQ(plan.points.size(), 4U);
    EXPECT_TRUE(plan.points[0].settings.empty());
    EXPECT_EQ(plan.test_of(plan.rows[0]).loading.max_axial_strain, 0.008);
    EXPECT_EQ(plan.test_of(plan.rows[3]).loading.max_axial_strain, 3e-3);
}

TEST_F(PlanTest, ASettingReplacesTheOtherWayToSayIt) {
    const Plan plan = plan_of(test_ +
                              "set = {\"loading.rate_tolerance\" = 0.02, \"material.cohesion\" = 5.0, "
                              "\"bond.law\" = \"coulomb\", \"material.tensile_strength\" = 7.0}\n");
    const ResolvedCase test = plan.test_of(plan.rows[0]);
    EXPECT_EQ(test.loading.axial_strain_rate(), nullptr);
    EXPECT_EQ(*test.loading.rate_tolerance(), 0.02);
    EXPECT_EQ(test.material.cohesion, 5.0);
}

TEST_F(PlanTest, SpacesAxesEvenlyInValuesOrInTheirLogarithms) {
    const Plan plan = plan_of(test_ +
                              "[[axis]]\nkey = \"material.normal_stiffness\"\nfrom = 1e6\nto = 1e8\ncount = 3\n"
                              "spacing = \"logarithmic\"\n[[axis]]\nkey = \"packing.count\"\nfrom = 40\nto = 60\n"
                              "count = 3\n");
    ASSERT_EQ(plan.axes[0].values.size(), 3U);
    EXPECT_NEAR(std::get<double>(plan.axes[0].values[1]), 1e7, 1e7 * 1e-12);
    EXPECT_EQ(std::get<std::int64_t>(plan.axes[1].values[1]), 50) << "whole where the key is";
    EXPECT_EQ(plan.points.size(), 9U);
    EXPECT_EQ(std::get<parts::CircleCount>(plan.test_of(plan.rows[1]).packing()->box).count, 50)
        << "the last axis changes fastest";
}

TEST_F(PlanTest, EachValueOfAnAxisMeetsEachOfTheOther) {
    const Plan plan = plan_of(test_ +
                              "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [20, 35]\n"
                              "[[axis]]\nkey = \"packing.count\"\nvalues = [40, 50, 60]\n");
    std::vector<std::pair<double, std::int64_t>> met;
    for (const PlanRow& row : plan.rows) {
        const ResolvedCase test = plan.test_of(row);
        met.emplace_back(test.material.friction_angle.value(), std::get<parts::CircleCount>(test.packing()->box).count);
    }
    EXPECT_EQ(met, (std::vector<std::pair<double, std::int64_t>>{
                       {20.0, 40}, {20.0, 50}, {20.0, 60}, {35.0, 40}, {35.0, 50}, {35.0, 60}}));
}

/// Largest difference between a box's fraction of the points and its area, over all boxes with one corner at 0.
double star_discrepancy(const std::vector<std::vector<double>>& points) {
    double worst = 0.0;
    for (double a = 0.1; a <= 1.0; a += 0.1) {
        for (double b = 0.1; b <= 1.0; b += 0.1) {
            const auto inside =
                std::count_if(points.begin(), points.end(), [&](const auto& p) { return p[0] < a && p[1] < b; });
            worst = std::max(worst, std::abs(static_cast<double>(inside) / static_cast<double>(points.size()) - a * b));
        }
    }
    return worst;
}

TEST_F(PlanTest, DesignsFillTheBoxEvenly) {
    for (const Sequence sequence : {Sequence::sobol, Sequence::halton}) {
        const auto points = design_points(sequence, 256, 2);
        const double worst = star_discrepancy(points);
        fmt::print("  discrepancy of 256 points: {:.3g}, of random ones about {:.3g}\n", worst, 1.0 / 16.0);
        EXPECT_LT(worst, 0.02);
        const auto fewer = design_points(sequence, 10, 2);
        EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), points.begin())) << "a design can be continued";
        const auto many = design_points(sequence, 64, most_design_axes);
        for (const auto& point : many)
            for (const double share : point) EXPECT_TRUE(share >= 0.0 && share < 1.0);
    }
    const Plan plan = plan_of(test_ +
                              "[[axis]]\nkey = \"material.normal_stiffness\"\nfrom = 1e6\nto = 1e8\n"
                              "spacing = \"logarithmic\"\n[[axis]]\nkey = \"material.friction_angle\"\nfrom = 10\n"
                              "to = 50\n[design]\npoints = 16\n");
    ASSERT_EQ(plan.points.size(), 16U);
    std::set<double> seen;
    for (const PlanRow& row : plan.rows) {
        const ResolvedCase test = plan.test_of(row);
        seen.insert(*test.material.friction_angle);
        EXPECT_TRUE(*test.material.normal_stiffness >= 1e6 && *test.material.normal_stiffness <= 1e8);
        EXPECT_TRUE(*test.material.friction_angle >= 10.0 && *test.material.friction_angle <= 50.0);
    }
    EXPECT_EQ(seen.size(), 16U);
}

TEST_F(PlanTest, CompanionsHaveHalfTheStepOrHalfTheRate) {
    const Plan plan = plan_of(test_, true);
    ASSERT_EQ(plan.rows.size(), 3U);
    const ResolvedCase asked = plan.test_of(plan.rows[0]), step = plan.test_of(plan.rows[1]),
                       rate = plan.test_of(plan.rows[2]);
    EXPECT_EQ(asked.step_scale, 1.0);
    EXPECT_EQ(step.step_scale, 0.5);
    EXPECT_EQ(*step.loading.axial_strain_rate(), *asked.loading.axial_strain_rate());
    EXPECT_EQ(*rate.loading.axial_strain_rate(), 0.5 * *asked.loading.axial_strain_rate());
    EXPECT_EQ(rate.step_scale, 1.0);
}

TEST_F(PlanTest, APackingsNumberIsTheSeedOfAllThatIsRandom) {
    const Plan plan = plan_of(
        "[[test]]\ncase = \"tension.toml\"\nset = {\"bond.law\" = \"coulomb\", \"material.tensile_strength\" = 7.0, "
        "\"material.cohesion\" = 9.0, \"bond.strength_distribution\" = \"weibull\", \"bond.strength_cv\" = 0.3, "
        "\"bond.strength_seed\" = 77}\n[packings]\ncount = 2\nfirst_seed = 5\n");
    const ResolvedCase second = plan.test_of(plan.rows[1]);
    EXPECT_EQ(second.packing()->seed, 6);
    EXPECT_EQ(second.bond.random->seed, 6);
}

TEST_F(PlanTest, APackingsNumberIsTheSeedOfItsJointsToo) {
    write_packed_case(folder_ / "jointed.toml", "tension",
                      "[mesh]\nkind = \"voronoi\"\nthick = 1e-3\n[bond]\nthick = 1.1e-3\n"
                      "[[joint_set]]\nname = \"bedding\"\nangle = 10.0\nspacing = 0.2\n");
    const Plan plan = plan_of("[[test]]\ncase = \"jointed.toml\"\n[packings]\ncount = 2\nfirst_seed = 5\n");
    EXPECT_EQ(plan.test_of(plan.rows[0]).joints.seed, 5);
    EXPECT_EQ(plan.test_of(plan.rows[1]).joints.seed, 6);
    EXPECT_EQ(plan.test_of(plan.rows[1]).packing()->seed, 6);
}

TEST_F(PlanTest, ThoseThatAreShippedArePossible) {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/plans")) {
        const Plan plan = read_plan(entry.path());
        // All shipped plans are ensembles, except the one with a test of each kind.
        const bool one_of_each = entry.path().stem() == "granite_laboratory";
        EXPECT_GE(plan.rows.size(), one_of_each ? table_of_names<LoadingKind>.size() : 20U) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 3U);
}

TEST_F(PlanTest, RefusesWhatCannotBe) {
    expect_refused("", "found no [[test]]");
    expect_refused("[[test]]\n", "case: found nothing");
    expect_refused("[[test]]\ncase = \"none.toml\"\n", "found no file");
    expect_refused(test_ + "[[axis]]\nvalues = [1]\n", "key: found nothing");
    expect_refused(test_ + "[[axis]]\nkey = \"material.colour\"\nvalues = [1]\n", "\"material.colour\"");
    expect_refused(test_ + "[[axis]]\nkey = \"material.friction_angle\"\n", "values, or from and to");
    expect_refused(test_ + "[[axis]]\nkey = \"material.friction_angle\"\nvalues = []\n", "values: found none");
    expect_refused(test_ + "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [1]\nfrom = 2\n",
                   "only one of the two");
    expect_refused(test_ + "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [120]\n", "found 120");
    expect_refused(test_ + "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [20, \"steep\"]\n",
                   "test tension at material.friction_angle = steep");
    expect_refused(test_ +
                       "[[axis]]\nkey = \"material.density\"\nfrom = -1\nto = 5\ncount = 3\n"
                       "spacing = \"logarithmic\"\n",
                   "numbers > 0");
    expect_refused(test_ + "[[axis]]\nkey = \"material.density\"\nfrom = 1\nto = 5\n", "points in [design]");
    expect_refused(test_ + "[design]\npoints = 4\n", "an [[axis]] with from and to");
    expect_refused(test_ + "[packings]\ncount = 0\n", "found 0");
    expect_refused(test_ + "[run]\nkeep = \"nothing\"\n", "\"nothing\"");
    expect_refused(test_ + "[run]\ntime_limit = -1\n", "found -1");
    expect_refused(test_ + "[runs]\n", "unknown key");
    expect_refused(test_ + test_, "two tests called tension");
    expect_refused(test_ + "[[axis]]\nkey = \"material.density\"\nvalues = [1]\ntests = [\"tense\"]\n", "found tense");
    expect_refused(test_ + "[[axis]]\nkey = \"mineral[2].cohesion\"\nvalues = [1]\n", "no such table");
    expect_refused(test_ + "[[axis]]\nkey = \"packing.seed\"\nfrom = 1\nto = 10000000\ncount = 100000000\n",
                   "found 100000000");
    const std::string many =
        "[[axis]]\nkey = \"material.density\"\nfrom = 1\nto = 2\ncount = 10000\n"
        "[[axis]]\nkey = \"material.friction_angle\"\nfrom = 1\nto = 2\ncount = 10000\n";
    expect_refused(test_ + many, "at most 10000000");
}

TEST_F(PlanTest, RefusesPackingsWhereNothingIsRandom) {
    write_packed_case(folder_ / "made.toml");
    std::string text = "[particles]\nfile = \"rock.dat\"\n[loading]\nkind = \"tension\"\nmax_axial_strain = 1e-3\n";
    write_text(folder_ / "fixed.toml", text);
    write_text(folder_ / "rock.dat", "");
    expect_refused("[[test]]\ncase = \"fixed.toml\"\n[packings]\ncount = 2\n", "nothing in the test fixed is random");
}

}  // namespace
}  // namespace crackle
