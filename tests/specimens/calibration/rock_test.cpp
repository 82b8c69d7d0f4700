// SPDX-License-Identifier: GPL-3.0-or-later
// Tests rock files: their contents, and what is refused before any test runs.

#include "specimens/calibration/rock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "specimens/calibration/search_space.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_circles_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::target_text;

class RockFile : public ::testing::Test {
  protected:
    RockFile() { testing::write_circles_rock(folder_); }
    Rock rock_of(const std::string& text) const {
        testing::write_text(folder_ / "rock.toml", text);
        return read_rock(folder_ / "rock.toml");
    }
    void expect_refused(const std::string& text, const std::string& says) const {
        const std::string said = testing::refusal([&] { rock_of(text); });
        EXPECT_NE(said.find(says), std::string::npos) << said << "\nof: " << text;
    }

    testing::ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";
    const std::string tests_ = testing::circles_tests, strengths_ = testing::strength_keys,
                      target_ = target_text("compression", "peak_stress", 5e7);
};

TEST_F(RockFile, IsReadWithItsDefaults) {
    const Rock rock = rock_of(tests_ + target_ + strengths_);
    ASSERT_EQ(rock.targets.size(), 1U);
    EXPECT_EQ(rock.targets[0].test, 0U);
    EXPECT_EQ(rock.targets[0].tolerance, 0.05);
    EXPECT_EQ(rock.title, "rock");
    EXPECT_TRUE(agrees("start between bounds above 0: their geometric mean", rock.free[0].start, 1e7, 1e-12));
    const ResolvedCase test = rock.case_of(1, std::vector<double>{4e6, 2.5});
    EXPECT_EQ(test.loading.kind, LoadingKind::tension);
    EXPECT_EQ(test.material.tensile_strength, 4e6);
    EXPECT_EQ(test.material.cohesion, 2.5 * 4e6) << "the search varies the ratio";
}

TEST_F(RockFile, VariablesGoBothWaysAndStayWithinTheBounds) {
    FreeKey ratio{.key = "a", .from = 2.0, .to = 50.0};
    EXPECT_TRUE(agrees("there and back", ratio.to_value(ratio.to_variable(7.0)), 7.0, 1e-14));
    EXPECT_EQ(ratio.to_value(99.0), 50.0);
    FreeKey linear{.key = "a", .from = 0.0, .to = 50.0};
    EXPECT_FALSE(linear.logarithmic());
    EXPECT_TRUE(agrees("there and back", linear.to_value(linear.to_variable(7.0)), 7.0, 1e-14));
}

TEST_F(RockFile, RefusesWithFileLineAndKey) {
    const std::string free = "[[free]]\nkey = \"material.cohesion\"\nfrom = 6e6\nto = 9e7\n";
    expect_refused(tests_ + strengths_, "found no [[target]]");
    expect_refused(tests_ + target_, "found no [[free]]");
    expect_refused(target_ + strengths_, "found no [[test]]");
    expect_refused(tests_ + target_text("shear", "peak_stress", 1) + free,
                   "rock.toml:6: [[target]] test: found \"shear\"");
    expect_refused(tests_ + target_text("tension", "beauty", 1) + free, "a figure of summary.json");
    expect_refused(tests_ + target_text("tension", "peak_stress", -1) + free, "found -1");
    expect_refused(tests_ + target_text("tension", "peak_stress", 1, "tolerance = 1.5") + free, "found 1.5");
    expect_refused(tests_ + "[[target]]\nfigure = \"peak_stress\"\nvalue = 1\n" + free,
                   "[[target]] test: found nothing");
    expect_refused(tests_ + target_ + "[[free]]\nkey = \"material.beauty\"\nfrom = 1\nto = 2\n", "a key of a case");
    expect_refused(tests_ + target_ + "[[free]]\nkey = \"bond.law\"\nfrom = 1\nto = 2\n", "a key with a numeric value");
    expect_refused(tests_ + target_ + "[[free]]\nkey = \"material.cohesion\"\nfrom = 2\nto = 1\n", "a number > from");
    expect_refused(tests_ + target_ + free + free, "one [[free]] per key");
    expect_refused(tests_ + target_ + free + "start = 1\n", "a number between");
    expect_refused(
        tests_ + target_ + "[[free]]\nkey = \"material.cohesion\"\nof = \"material.density\"\nfrom = 1\nto = 2\n",
        "the key of an earlier [[free]] table");
    expect_refused(tests_ + target_ + free + "[packings]\nfit = 2\n", "a whole number, 4 to 10000");
    expect_refused(tests_ + target_ + free + "[[curve]]\ntest = \"tension\"\nfile = \"none.csv\"\n", "found no file");
    expect_refused(tests_ + target_ + free + "[speed]\n", "found an unknown key");
    expect_refused(tests_ + target_ + target_ + free, "peak_stress twice");
    expect_refused(tests_ + target_text("tension", "peak_stress.foo", 1) + free, "a figure of summary.json");
    expect_refused(tests_ + target_ + "[[free]]\nkey = \"loading.max_axial_strain\"\nfrom = 1e-3\nto = 1e-2\n",
                   "a key that describes the rock, not how it is tested");
    expect_refused("[[test]]\nname = \"../evil\"\ncase = \"tension.toml\"\n" + free, "a name without /");
    expect_refused("[[test]]\ncase = \"compression.toml\"\nset = {\"material.cohesion\" = 1e7}\n" + target_ + free,
                   "to which `set` of test compression also gives a value");
    testing::write_text(folder_ / "curve.csv", "strain,stress\n0,0\n1,1\n");
    expect_refused(tests_ + target_ + free + "[[curve]]\ntest = \"tension\"\nfile = \"curve.csv\"\n",
                   "expected columns axial_strain and axial_stress");
    testing::write_text(folder_ / "curve.csv", "axial_strain,axial_stress\n0,0\n1,one\n");
    expect_refused(tests_ + target_ + free + "[[curve]]\ntest = \"tension\"\nfile = \"curve.csv\"\n", "curve.csv:3");
}

TEST_F(RockFile, AMeasuredCurveIsReadWithIt) {
    testing::write_text(folder_ / "curve.csv", "time,axial_strain,axial_stress\n0,0,0\n1,0.001,nan\n2,0.002,3e6\n");
    const Rock rock = rock_of(tests_ + target_ + strengths_ + "[[curve]]\ntest = \"tension\"\nfile = \"curve.csv\"\n");
    ASSERT_EQ(rock.curves.size(), 1U);
    EXPECT_EQ(rock.curves[0].test, 1U);
    EXPECT_EQ(rock.curves[0].points, (std::vector<std::pair<double, double>>{{0.0, 0.0}, {0.002, 3e6}}));
}

TEST_F(RockFile, KeysAndTargetsGoToTheSearchThatFindsThem) {
    const std::string modulus = target_text("compression", "youngs_modulus", 1e10);
    const Rock both = rock_of(tests_ + modulus + target_ + testing::elastic_keys + strengths_);
    const SearchSpace space(both);
    EXPECT_EQ(space.linear_keys, (std::vector<Eigen::Index>{0, 1}));
    EXPECT_EQ(space.linear_targets, (std::vector<Eigen::Index>{0}));
    EXPECT_EQ(space.other_keys, (std::vector<Eigen::Index>{2, 3}));
    EXPECT_EQ(space.level_key, 2);
    EXPECT_TRUE(space.goes_with_level(1));
    // Without an elastic key, a modulus is a target like any other, and strengths do not change in proportion to it.
    const Rock strengths = rock_of(tests_ + modulus + target_ + strengths_);
    const SearchSpace other(strengths);
    EXPECT_TRUE(other.linear_targets.empty());
    EXPECT_FALSE(other.goes_with_level(0));
    EXPECT_TRUE(other.goes_with_level(1));
    // Cohesion as a key of its own does not follow the tensile strength.
    const Rock apart = rock_of(tests_ + target_ +
                               "[[free]]\nkey = \"material.tensile_strength\"\nfrom = 1e6\nto = 1e7\n"
                               "[[free]]\nkey = \"material.cohesion\"\nfrom = 6e6\nto = 9e7\n");
    EXPECT_EQ(SearchSpace(apart).level_key, -1);
}

TEST_F(RockFile, TargetsAreRatiosAndLawsOfSeveralTests) {
    const std::string pressed = tests_ + testing::pressed_tests;
    const Rock rock = rock_of(pressed + target_ + target_text("pressed", "peak_stress", 6e7) +
                              target_text("compression", "crack_initiation_stress", 0.45, "over = \"peak_stress\"") +
                              target_text("compression", "youngs_modulus", 300, "over = \"peak_stress\"") +
                              testing::law_target_text("friction_angle", 40) +
                              testing::law_target_text("hoek_brown_m", 15) + testing::elastic_keys + strengths_);
    ASSERT_EQ(rock.targets.size(), 6U);
    EXPECT_EQ(rock.targets[2].name(rock.tests), "compression crack_initiation_stress over peak_stress");
    EXPECT_EQ(rock.targets[2].unit(true), "");
    EXPECT_EQ(rock.targets[4].tests, (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(rock.targets[4].name(rock.tests), "compression, pressed, squeezed friction_angle");
    EXPECT_EQ(rock.targets[4].unit(true), "deg");
    EXPECT_EQ(rock.targets[0].unit(true), "Pa");
    const SearchSpace space(rock);
    EXPECT_TRUE(space.linear_targets.empty()) << "the ratio of a modulus and a strength is not a linear target";
    ASSERT_GE(space.level_key, 0);
    EXPECT_TRUE(space.goes_with_level(0));
    EXPECT_FALSE(space.goes_with_level(1)) << "the pressure stays as it is";
    EXPECT_FALSE(space.goes_with_level(2)) << "a ratio of strengths";
    EXPECT_FALSE(space.goes_with_level(4));
}

TEST_F(RockFile, RefusesRatiosAndLawsThatAreNone) {
    const std::string pressed = tests_ + testing::pressed_tests;
    expect_refused(tests_ + target_text("tension", "peak_stress", 1, "over = \"beauty\"") + strengths_,
                   "[[target]] over: found \"beauty\", expected a figure of summary.json");
    expect_refused(tests_ + target_text("tension", "peak_stress", 1, "over = \"peak_stress\"") + strengths_,
                   "the figure itself");
    expect_refused(pressed + testing::law_target_text("peak_stress", 1) + strengths_,
                   "of several tests, expected one of friction_angle, hoek_brown_m");
    expect_refused(pressed + target_text("pressed", "friction_angle", 40) + strengths_,
                   "[[target]] tests: found nothing, expected the compression tests to which friction_angle is fitted");
    expect_refused(
        pressed + testing::law_target_text("friction_angle", 40, "[\"compression\", \"sheared\"]") + strengths_,
        "found \"sheared\", expected one of compression, tension, pressed, squeezed");
    expect_refused(
        pressed + testing::law_target_text("friction_angle", 40, "[\"compression\", \"compression\"]") + strengths_,
        "each test once");
    expect_refused(
        pressed + testing::law_target_text("friction_angle", 40, "[\"compression\", \"pressed\"]") + strengths_,
        "found 2 confining pressures, expected 3 or more");
    expect_refused(pressed +
                       testing::law_target_text("friction_angle", 40, "[\"tension\", \"pressed\", \"squeezed\"]") +
                       strengths_,
                   "found tension, a tension test, expected compression tests");
    expect_refused(pressed + testing::law_target_text("friction_angle", 40) + "over = \"peak_stress\"\n" + strengths_,
                   "found this key together with tests");
}

TEST_F(RockFile, CornersOfTheBoundsAreJudgedBeforeAnyTest) {
    // At the lower corner of the bounds, cohesion is less than friction times tensile strength.
    expect_refused(
        tests_ + target_ +
            "[[free]]\nkey = \"material.tensile_strength\"\nfrom = 1e6\nto = 1e8\n"
            "[[free]]\nkey = \"material.cohesion\"\nof = \"material.tensile_strength\"\nfrom = 0.3\nto = 6\n",
        "material.tensile_strength = 1e+06, material.cohesion over material.tensile_strength = 0.3, a corner");
}

}  // namespace
}  // namespace crackle
