// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the reading of measured curves: units in the heading, quotients of columns, and scales that do not fit.

#include "specimens/recordings/measured_curve.hpp"

#include <gtest/gtest.h>

#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

class MeasuredCurve : public ::testing::Test {
  protected:
    StrainsAndStresses read(const std::string& text) const {
        testing::write_text(file_, text);
        return read_measured_curve(file_);
    }
    std::string refused(const std::string& text) const {
        return testing::refusal([&] { read(text); });
    }

    testing::ScratchFolder scratch_;
    std::filesystem::path file_ = scratch_ / "laboratory.csv";
};

void expect_points(const StrainsAndStresses& found, const StrainsAndStresses& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_DOUBLE_EQ(found[k].first, expected[k].first);
        EXPECT_DOUBLE_EQ(found[k].second, expected[k].second);
    }
}

TEST_F(MeasuredCurve, UnitsInTheHeadingAreConverted) {
    const StrainsAndStresses expected{{0.0, 0.0}, {0.0025, 180e6}};
    expect_points(read("axial_strain,axial_stress\n0,0\n0.0025,180e6\n"), expected);
    expect_points(read("axial_strain (%),axial_stress (MPa)\n0,0\n0.25,180\n"), expected);
    expect_points(read("Axial strain (%),Axial Stress (MPa)\n0,0\n0.25,180\n"), expected);
    expect_points(read("time,axial_stress [kPa],axial_strain [‰]\n0,0,0\n1,180000,2.5\n"), expected);
}

TEST_F(MeasuredCurve, ForceOverAreaAndDisplacementOverLengthAreStressAndStrain) {
    expect_points(
        read("displacement (mm),length (mm),force (kN),area (mm2)\n0,100,0,2000\n0.25,100,360,2000\n,100,1,2000\n"),
        {{0.0, 0.0}, {0.0025, 180e6}});
    EXPECT_NE(refused("displacement (mm),length (mm),force (kN),area (mm2)\n0,100,0,0\n1,100,1,1\n")
                  .find("laboratory.csv:2: found area = 0, expected a number > 0"),
              std::string::npos);
}

TEST_F(MeasuredCurve, UnknownUnitsAndMissingColumnsAreRefused) {
    EXPECT_NE(refused("axial_strain,axial_stress (ksi)\n0,0\n1,1\n")
                  .find("found the unit 'ksi' of axial_stress, expected one of Pa, kPa, MPa"),
              std::string::npos);
    EXPECT_NE(
        refused("axial_strain (%),axial_stress (MPa)\n0,0\n-0.1,-12\n").find("found stresses down to -1.2e+07 Pa"),
        std::string::npos);
    EXPECT_NE(refused("strain,stress\n0,0\n1,1\n").find("expected columns axial_strain and axial_stress"),
              std::string::npos);
    EXPECT_NE(refused("axial_strain,axial_strain (%),axial_stress\n0,0,0\n1,1,1\n").find("two columns axial_strain"),
              std::string::npos);
    EXPECT_NE(refused("displacement,force,area\n0,0,1\n1,1,1\n").find("displacement, length, force and area"),
              std::string::npos);
}

TEST_F(MeasuredCurve, ScalesThatDifferByAUnitAreRefused) {
    const StrainsAndStresses curve{{0.0, 0.0}, {0.0025, 180.0}};
    require_like_scale("laboratory.csv", curve, 0.003, 150.0, "Pa");
    const auto refusal = [&](double strain, double stress) {
        return testing::refusal([&] { require_like_scale("laboratory.csv", curve, strain, stress, "Pa"); });
    };
    EXPECT_NE(refusal(0.003, 150e6)
                  .find("axial_stress: found values up to 180 Pa, expected the scale of the tests, "
                        "1.5e+08 Pa; state the unit in the heading, for example axial_stress (MPa)"),
              std::string::npos);
    EXPECT_NE(refusal(0.003 / 100.0, 150.0).find("axial_strain: found values up to 0.0025"), std::string::npos);
}

TEST_F(MeasuredCurve, StrengthsOfCoresHaveTheirErrors) {
    testing::write_text(file_, "confining_pressure (MPa),strength (MPa),error (MPa)\n0,200,8\n10,326,\n");
    const std::vector<StrengthOfCores> found = read_measured_strengths(file_);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_DOUBLE_EQ(found[0].strength, 200e6);
    EXPECT_DOUBLE_EQ(found[0].error, 8e6);
    EXPECT_DOUBLE_EQ(found[1].confinement, 10e6);
    EXPECT_EQ(found[1].error, 0.0);
    testing::write_text(file_, "confining_pressure,strength\n10,5\n");
    EXPECT_NE(testing::refusal([&] { read_measured_strengths(file_); }).find("laboratory.csv:2: found"),
              std::string::npos);
}

}  // namespace
}  // namespace crackle
