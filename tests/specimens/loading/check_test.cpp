// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the estimates of --check against closed forms and against tests.

#include "specimens/loading/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;

TEST(StrainOfShare, CountsOnlyWhatCanBreak) {
    std::vector<LinearBond> bonds(10);
    for (std::size_t k = 0; k < bonds.size(); ++k) {
        bonds[k].strength = 1.0;
        bonds[k].break_strain = 1e-3 * static_cast<double>(10 - k);
    }
    EXPECT_EQ(strain_of_share(bonds, 0.0), 1e-3) << "at least one";
    EXPECT_EQ(strain_of_share(bonds, 0.5), 6e-3);
    bonds[9].strength = std::numeric_limits<double>::infinity();  // the bond that would break first is unbreakable
    EXPECT_EQ(strain_of_share(bonds, 0.0), 2e-3);
    EXPECT_TRUE(std::isinf(strain_of_share({}, 0.1)));
}

TEST(TestCheck, CountsGrainsStepsAndSeconds) {
    const testing::ScratchFolder scratch;
    const ResolvedCase test = read_case(testing::write_small_case(scratch / "", {}));
    const TestCheck check = check_test(test);
    const TestSetup& setup = check.test.setup;
    EXPECT_TRUE(
        agrees("grains across", check.grains_across,
               std::sqrt(static_cast<double>(setup.specimen.particles) * setup.specimen.width / setup.specimen.height),
               1e-12));
    EXPECT_TRUE(
        agrees("steps to the end", check.to_end.steps, 0.005 / 0.02 / check.test.world.stepping.time_step, 1e-12));
    EXPECT_TRUE(agrees("seconds to the end", check.to_end.seconds, check.to_end.steps / check.steps_per_second, 1e-12));
    ASSERT_TRUE(check.strength && check.to_strength && check.first_break);
    EXPECT_TRUE(
        agrees("stress of the estimate", check.strength->stress, check.youngs_modulus * check.strength->strain, 1e-12));
    EXPECT_GE(check.strength->strain, check.first_break->strain);
    EXPECT_EQ(check.rate, check.slowest_rate) << "a given rate is not changed";
}

TEST(TestCheck, EstimatesNoStrengthUnderAPressure) {
    const testing::ScratchFolder scratch;
    testing::SmallCase wanted;
    wanted.kind = "biaxial";
    wanted.output += "\n[confinement]\npressure = 1e3";
    const TestCheck check = check_test(read_case(testing::write_small_case(scratch / "", wanted)));
    EXPECT_FALSE(check.strength || check.to_strength);
    EXPECT_TRUE(std::isfinite(check.youngs_modulus));
    ASSERT_FALSE(check.warnings.empty());
    EXPECT_NE(check.warnings.front().find("without the confining pressure"), std::string::npos);
}

std::string warnings_of(const std::string& material, double rate = 0.02) {
    const testing::ScratchFolder scratch;
    testing::SmallCase wanted;
    wanted.kind = "compression";
    wanted.mesh = "voronoi";
    wanted.material = material;
    wanted.bond = "law = \"coulomb\"";
    wanted.rate = rate;
    std::string all;
    for (const std::string& warning : check_test(read_case(testing::write_small_case(scratch / "", wanted))).warnings)
        all += warning + '\n';
    return all;
}

TEST(TestCheck, SaysWhereANumberLooksLikeAnotherUnit) {
    const std::string area = "units = \"area\"\nstiffness_ratio = 2.5\n";
    const std::string sound = warnings_of(area + "contact_modulus = 1e7\ntensile_strength = 1.5e4\ncohesion = 5e4");
    EXPECT_EQ(sound.find("Values must be in Pa"), std::string::npos) << sound;
    EXPECT_EQ(sound.find("far beyond the failure strain of any rock"), std::string::npos) << sound;
    const std::string mega = warnings_of(area + "contact_modulus = 76e9\ntensile_strength = 9\ncohesion = 66");
    EXPECT_NE(mega.find("material.tensile_strength = 9 Pa is only 1e-10 of the contact modulus: is it meant in MPa?"),
              std::string::npos)
        << mega;
    // Loading is faster than its waves, so the test becomes unstable within some tens of steps, however few steps it
    // takes per second.
    const std::string giga = warnings_of(area + "contact_modulus = 60\ntensile_strength = 1e-3\ncohesion = 1e-2", 5.0);
    EXPECT_NE(giga.find("while the speed of stepping was measured, unstable at step"), std::string::npos) << giga;
    EXPECT_NE(giga.find("material.contact_modulus = 60 Pa is softer than any rock or soil: is it meant in GPa?"),
              std::string::npos)
        << giga;
    const std::string points = warnings_of("tensile_strength = 9e6\ncohesion = 66e6");
    EXPECT_NE(points.find("strengths are in N per contact point here; to give them in Pa, set units = \"area\""),
              std::string::npos)
        << points;
    EXPECT_EQ(points.find("presses a corner in"), std::string::npos) << points;
    EXPECT_EQ(points.find("may end before"), std::string::npos) << points;
}

/// Judges the effect of platens on the corners they touch. Bonds have a friction angle of 50 degrees, broken bonds 15.
TEST(TestCheck, ADiscIsJudgedByTheFrictionOfItsBonds) {
    const testing::ScratchFolder scratch;
    std::ofstream(scratch / "case.toml") << "include = \"" CRACKLE_SOURCE_DIR
                                            "/specimens/laboratory/granite_brazilian.toml\"\n"
                                            "[packing]\nwidth = 0.02\nheight = 0.02\n";
    const TestCheck check = check_test(read_case(scratch / "case.toml"));
    ASSERT_TRUE(check.disc.has_value());
    EXPECT_TRUE(agrees("friction angle", check.disc->friction_angle, 50.0, 1e-12));
    const double sine = std::sin(50.0 * std::numbers::pi / 180.0);
    EXPECT_TRUE(agrees("3 + N", check.disc->needed, 3.0 + (1.0 + sine) / (1.0 - sine), 1e-12));
}

TEST(TestCheck, CornersComeNearerToAPlatenAsTheThicknessShrinks) {
    const auto pressed = [](const char* thick, const char* bond) {
        const testing::ScratchFolder scratch;
        const auto file = testing::write_small_case(scratch / "", {.kind = "compression", .mesh = "voronoi"});
        ResolvedCase test = read_case(file);
        test.mesh->gap = parts::MeshGap{std::stod(thick), {}};
        test.bond.thick = std::stod(bond);
        return check_test(test);
    };
    const TestCheck thick = pressed("1e-3", "1.08e-3"), thin = pressed("1e-5", "9e-5");
    EXPECT_TRUE(agrees("distance from the platen's face", thick.corner_distance, 1e-3, 1e-3));
    EXPECT_TRUE(agrees("distance from the platen's face", thin.corner_distance, 1e-5, 1e-3));
    // The overlap at bonding, and therefore the strength, is the same.
    EXPECT_TRUE(agrees("way of the corner", thin.corner_closing, thick.corner_closing, 0.5));
    EXPECT_GT(thin.corner_closing, thin.corner_distance);
}

TEST(TestCheck, OfATestByToleranceTheRateMayFall) {
    const testing::ScratchFolder scratch;
    ResolvedCase test = read_case(testing::write_small_case(scratch / "", {}));
    test.loading.rate = parts::RateTolerance{0.01};
    const TestCheck check = check_test(test);
    EXPECT_TRUE(agrees("slowest rate over the first", check.slowest_rate / check.rate, 0.15, 1e-12));
}

}  // namespace
}  // namespace crackle
