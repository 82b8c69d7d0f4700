// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that numbers probably given in other units are reported with a suggestion, and that usual values of rocks are
// not.

#include "specimens/loading/unlikely_numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace crackle {
namespace {

ResolvedCase granite() {
    ResolvedCase test;
    test.material.units = StiffnessUnits::area;
    test.material.density = 2650.0;
    test.material.friction_angle = 40.0;
    test.material.normal_stiffness = 76e9;
    test.material.tensile_strength = 12e6;
    test.material.cohesion = 60e6;
    test.bond.law = BondLaw::coulomb;
    return test;
}

TestedSpecimen core() {
    TestedSpecimen specimen;
    specimen.width = 0.05;
    specimen.height = 0.1;
    specimen.area = specimen.width * specimen.height;
    specimen.particles = 1250;
    return specimen;
}

std::string notices_of(const ResolvedCase& test, const TestedSpecimen& specimen = core()) {
    const std::string all = fmt::format("{}", fmt::join(unlikely_numbers(test, specimen), "\n"));
    if (!all.empty()) fmt::print("  {}\n", all);
    return all;
}

TEST(UnlikelyNumbers, OfARockAreNone) { EXPECT_EQ(notices_of(granite()), ""); }

TEST(UnlikelyNumbers, AreNamedWithWhatTheyAreLikelyToMean) {
    const auto with = [](auto&& change) {
        ResolvedCase test = granite();
        change(test);
        return notices_of(test);
    };
    EXPECT_EQ(with([](ResolvedCase& t) { t.material.density = 2.65; }),
              "material.density = 2.65 kg/m2 is lighter than any rock: is it meant in g/cm3? That would be 2650 kg/m2");
    EXPECT_EQ(
        with([](ResolvedCase& t) { t.material.friction_angle = 0.6; }),
        "material.friction_angle = 0.6 degrees is almost zero: is it meant in radians? That would be 34.4 degrees");
    EXPECT_EQ(with([](ResolvedCase& t) { t.material.friction_angle = 0.0; }),
              "material.friction_angle = 0 degrees lets broken faces slide freely, and pressure does not strengthen "
              "bonds; rocks have 20 to 45 degrees");
    EXPECT_NE(
        with([](ResolvedCase& t) { t.material.residual_friction_angle = 0.5; }).find("residual_friction_angle = 0.5"),
        std::string::npos);
    EXPECT_EQ(
        with([](ResolvedCase& t) { t.material.cohesion = 240e6; }),
        "material.cohesion = 2.4e+08 Pa is 20 times the tensile strength, while 1 to 10 is usual for rocks; is one of "
        "them in another unit?");
    EXPECT_NE(with([](ResolvedCase& t) { t.material.tensile_strength = 12.0; }).find("is it meant in MPa?"),
              std::string::npos);
    EXPECT_NE(with([](ResolvedCase& t) { t.material.normal_stiffness = 76.0; }).find("is it meant in GPa?"),
              std::string::npos);
}

TEST(UnlikelyNumbers, MillimetresAreNoMetres) {
    TestedSpecimen large = core();
    large.width = 50.0;
    large.height = 100.0;
    large.area = 5000.0;
    EXPECT_EQ(notices_of(granite(), large),
              "the specimen is 50 m by 100 m, with grains of 2 m that are as stiff as rock: are its lengths given in "
              "mm? Values must be in m");
    ResolvedCase mass = granite();
    mass.joints.traces.emplace_back();
    EXPECT_EQ(notices_of(mass, large), "") << "blocks between joints may be large";
    ResolvedCase soft = granite();
    soft.material.normal_stiffness = 1e8;
    EXPECT_EQ(notices_of(soft, large), "") << "as stiff as soil";
}

TEST(UnlikelyNumbers, OfAMineralAreItsOwn) {
    ResolvedCase test = granite();
    test.material.friction_angle = 0.6;
    test.minerals.list.resize(2);
    for (parts::Mineral& mineral : test.minerals.list) mineral.material = test.material;
    test.minerals.list[1].material.density = 2.7;
    const std::vector<std::string> all = unlikely_numbers(test, core());
    ASSERT_EQ(all.size(), 2U) << fmt::format("{}", fmt::join(all, "\n"));
    EXPECT_TRUE(all[0].starts_with("material.friction_angle"));
    EXPECT_TRUE(all[1].starts_with("mineral[2].density"));
}

}  // namespace
}  // namespace crackle
