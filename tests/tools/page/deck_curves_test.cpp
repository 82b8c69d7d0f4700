// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that rows of energy.dat, f-d_curve.dat and velocity_y.dat are read as curves over time, and appear as such on
// the page.

#include "specimens/recordings/deck_curves.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"
#include "tests/support/page_contents.hpp"
#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

using namespace testing;

class DeckCurvesTest : public ProgramCall {
  protected:
    DeckCurvesTest() : ProgramCall("") {
        std::filesystem::create_directories(folder_ / "run");
        write(
            "run/energy.dat",
            "# step enrg enva enka enca enfr enxd enxf err enfb\n0 1 2 3 4 5 6 7 8 9\n50 10 20 30 40 50 60 70 80 90\n");
        write("run/f-d_curve.dat",
              "1 7 0.5 1 -0.5 2 3 4\n1 2 0 0 0 0 0 0\n150 7 1.5 11 -1.5 12 13 14\n150 2 0 0 0 0 0 0\n");
        write("run/velocity_y.dat", "# step body vy\n0 7 -1\n250 7 -2\n");
    }
    DeckCurves curves(const std::vector<DeckFrameFile::Head>& frames) const {
        return read_deck_curves(folder_ / "run", frames);
    }
    std::string refusal() const {
        try {
            curves(frames_);
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            return error.what();
        }
        return "read without complaint";
    }
    // The time step was halved at step 100.
    const std::vector<DeckFrameFile::Head> frames_{
        {0, 0.0, {}, 0, 0, 1}, {100, 0.01, {}, 0, 0, 2}, {200, 0.015, {}, 0, 0, 3}};
};

TEST_F(DeckCurvesTest, ColumnsAreThoseOfTheFiles) {
    const DeckCurves read = curves(frames_);
    EXPECT_TRUE(read.in_time);
    EXPECT_EQ(read.energy.of(DeckEnergy::potential), (std::vector<double>{1.0, 10.0}));
    EXPECT_EQ(read.energy.of(DeckEnergy::displacement_work), (std::vector<double>{6.0, 60.0}));
    EXPECT_EQ(read.energy.of(DeckEnergy::error), (std::vector<double>{8.0, 80.0}));
    EXPECT_EQ(read.energy.of(DeckEnergy::broken_bonds), (std::vector<double>{9.0, 90.0}));
    ASSERT_EQ(read.bodies.size(), 2U);
    const DeckBodyCurve& body = read.bodies[0];
    EXPECT_EQ(body.id, 7);
    EXPECT_EQ(body.force_x, (std::vector<double>{0.5, 1.5}));
    EXPECT_EQ(body.x, (std::vector<double>{1.0, 11.0}));
    EXPECT_EQ(body.force_y, (std::vector<double>{-0.5, -1.5}));
    EXPECT_EQ(body.y, (std::vector<double>{2.0, 12.0}));
    EXPECT_EQ(body.moment, (std::vector<double>{3.0, 13.0}));
    EXPECT_EQ(body.angle, (std::vector<double>{4.0, 14.0}));
    ASSERT_EQ(read.velocities.size(), 1U);
    EXPECT_EQ(read.velocities[0].vy, (std::vector<double>{-1.0, -2.0}));
}

TEST_F(DeckCurvesTest, TimesAreThoseOfTheFramesWhateverTheStepWas) {
    const DeckCurves read = curves(frames_);
    const auto expect_times = [](const char* what, const std::vector<double>& expected,
                                 const std::vector<double>& got) {
        ASSERT_EQ(expected.size(), got.size()) << what;
        for (std::size_t k = 0; k < got.size(); ++k) {
            fmt::print("  {}: expected {} s, got {} s\n", what, expected[k], got[k]);
            EXPECT_NEAR(got[k], expected[k], 1e-15) << what;
        }
    };
    expect_times("energy", {0.0, 0.005}, read.energy.time);
    expect_times("body", {0.0001, 0.0125}, read.bodies[0].time);
    expect_times("velocity, behind the last frame", {0.0, 0.0175}, read.velocities[0].time);
}

TEST_F(DeckCurvesTest, AreOverStepsWhereASingleFrameTellsNoTime) {
    const DeckCurves read = curves({frames_.front()});
    EXPECT_FALSE(read.in_time);
    EXPECT_EQ(read.energy.time, (std::vector<double>{0.0, 50.0}));
}

TEST_F(DeckCurvesTest, WhatIsMissingOrWasCutShortHasNoRows) {
    std::filesystem::remove(folder_ / "run" / "f-d_curve.dat");
    write("run/energy.dat", read("run/energy.dat") + "100 1 2 3 4 5 6 7 8 9");  // as if killed while writing
    const DeckCurves read = curves(frames_);
    EXPECT_TRUE(read.bodies.empty());
    EXPECT_EQ(read.energy.time.size(), 2U);
}

TEST_F(DeckCurvesTest, DamageIsNamedByFileAndLine) {
    const std::string energy = read("run/energy.dat");
    for (const auto& [row, says] : {std::pair("100 1 2 3\n", "energy.dat:4: enca"),
                                    {"100 1 2 3 4 x 6 7 8 9\n", "energy.dat:4: enfr: found 'x'"},
                                    {"100 1 2 3 4 5 6 7 8 9 10\n", "energy.dat:4"},
                                    {"50 1 2 3 4 5 6 7 8 9\n", "energy.dat:4: step: found '50'"}}) {
        write("run/energy.dat", energy + row);
        EXPECT_NE(refusal().find(says), std::string::npos) << says;
    }
    write("run/energy.dat", energy);
    write("run/f-d_curve.dat", read("run/f-d_curve.dat") + "150 7 1 2 3 4 5 6\n");
    EXPECT_NE(refusal().find("f-d_curve.dat:5: body: found '7'"), std::string::npos) << "the same body and step twice";
}

/// The shipped chain of 20 discs, four of which have a row at each of 400 steps.
TEST_F(DeckCurvesTest, ThePageHasThemAndThinsThemToTheirExtremes) {
    ASSERT_EQ(call(fmt::format("run -q '{}' -o wave --steps 1700", shipped_deck("wave_chain").string())).code, 0);
    ASSERT_EQ(call("view wave -o page.html").code, 0) << read(err_);
    const PageContents page(folder_ / "page.html");
    EXPECT_EQ(page.test()["curves"]["bodies"], nlohmann::json({{"ids", {11, 13, 15, 17}}, {"of", 4}}));
    const Rows energies = read_rows(folder_ / "wave" / "energy.dat");
    const std::vector<double> time = page.plain("energy.time"), kinetic = page.plain("energy.enva");
    fmt::print("  energy: {} rows in the file, {} on the page\n", energies.size(), time.size());
    ASSERT_EQ(energies.size(), 1701U);
    EXPECT_LT(time.size(), energies.size());
    EXPECT_NEAR(time.back(), 1700e-5, 1e-8);
    const auto ends_of = [](const std::vector<double>& values) { return std::ranges::minmax(values); };
    std::vector<double> of_file;
    for (const auto& row : energies) of_file.push_back(row[2]);
    EXPECT_EQ(ends_of(kinetic).min, ends_of(of_file).min);
    EXPECT_EQ(ends_of(kinetic).max, ends_of(of_file).max);
    std::vector<double> x;
    for (const auto& row : rows_of(read_rows(folder_ / "wave" / "f-d_curve.dat"), 1, 13.0)) x.push_back(row[3]);
    EXPECT_EQ(ends_of(page.plain("body.13.x")).max, ends_of(x).max);
    EXPECT_EQ(ends_of(page.plain("body.13.x")).min, ends_of(x).min);
}

}  // namespace
}  // namespace crackle
