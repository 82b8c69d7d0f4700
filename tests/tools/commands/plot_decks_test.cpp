// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle plot` for deck runs: its figures must show what the files contain.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/deck_files.hpp"
#include "tests/support/drawn_figure.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/sample_results.hpp"

namespace crackle {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// Curves of runs of the shipped chain of 20 discs and of the falling circle.
class PlotDecks : public ProgramCall {
  protected:
    PlotDecks() : ProgramCall("plot") {
        for (const auto& [deck, out, steps] : {std::tuple("wave_chain", "wave", 400), {"circle", "falling", 3000}}) {
            const int status = std::system(fmt::format("cd '{}' && '{}' run -q '{}' -o {} --steps {}", folder_.string(),
                                                       CRACKLE_PROGRAM, shipped_deck(deck).string(), out, steps)
                                               .c_str());
            EXPECT_EQ(status, 0);
        }
    }
    std::string drawn(const std::string& words, const std::string& file) const {
        const Answer answer = call(words + " --force -o " + file);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(answer.out, file + "\n");
        return read(file);
    }
    /// Lines from the left end of a frame to the end of its data, 6 % before the right end, in drawing order; a
    /// straight line has two points.
    static std::vector<std::vector<Vec2>> curves_of(const std::string& svg) {
        const std::vector<std::vector<Vec2>> frames = frames_of(svg);
        std::vector<std::vector<Vec2>> curves;
        for (const std::vector<Vec2>& line : lines_of(svg)) {
            const bool of_a_frame = std::ranges::any_of(frames, [&](const std::vector<Vec2>& frame) {
                const double left = frame[1].x, width = frame[2].x - left;
                return line.size() > 1 && std::abs(line.front().x - left) < 0.01 * width &&
                       std::abs(line.back().x - left - width / 1.06) < 0.01 * width &&
                       line.front().y > frame[0].y - 1.0 && line.front().y < frame[1].y + 1.0;
            });
            if (of_a_frame) curves.push_back(line);
        }
        return curves;
    }
};

TEST_F(PlotDecks, DisplacementsOfWatchedBodiesAreThoseOfTheFile) {
    const std::string svg = drawn("wave --what all --bodies 11 13 --width 200", "figure.svg");
    const std::vector<std::vector<Vec2>> frames = frames_of(svg), curves = curves_of(svg);
    ASSERT_EQ(frames.size(), 2U)
        << "energy, and displacement along the chain: nothing moves across it, nothing is driven";
    // Bodies 11 and 13 are drawn last. The heights of their peaks above their starts must be in the same ratio as the
    // values in the file.
    const auto rise_drawn = [&](std::size_t from_end) {
        const std::vector<Vec2>& curve = curves[curves.size() - from_end];
        double highest = curve.front().y;
        for (const Vec2 point : curve) highest = std::min(highest, point.y);
        return curve.front().y - highest;
    };
    const auto rise_in_file = [&](double body) {
        const Rows rows = rows_of(read_rows(folder_ / "wave" / "f-d_curve.dat"), 1, body);
        double most = 0.0;
        for (const auto& row : rows) most = std::max(most, row[3] - rows.front()[3]);
        return most;
    };
    const double expected = rise_in_file(13.0) / rise_in_file(11.0), got = rise_drawn(1) / rise_drawn(2);
    fmt::print("  peak of body 13 over that of 11: expected {:.5f}, got {:.5f}\n", expected, got);
    EXPECT_NEAR(got, expected, 1e-3);
    EXPECT_EQ(curves_of(drawn("wave --what displacement", "figure.svg")).size(), 8U)
        << "of four bodies, along the chain and across it";
    EXPECT_EQ(frames_of(drawn("wave --what displacement", "figure.svg")).size(), 2U) << "on request, also across it";
}

TEST_F(PlotDecks, PartsOfTheEnergyThatAreZeroAreLeftOutButTheError) {
    // Potential, kinetic and strain energy and the closing error of a circle that falls and bounces without losses.
    EXPECT_EQ(curves_of(drawn("falling --what energy", "figure.svg")).size(), 4U);
    EXPECT_EQ(curves_of(drawn("wave --what energy", "figure.svg")).size(), 3U) << "no gravity";
    EXPECT_EQ(frames_of(drawn("wave falling --what energy", "figure.svg")).size(), 2U) << "a panel a run";
}

TEST_F(PlotDecks, RunsAreComparedInOnePanel) {
    const std::string svg = drawn("falling falling --what velocity --labels one other", "figure.svg");
    EXPECT_EQ(frames_of(svg).size(), 1U);
    EXPECT_EQ(curves_of(svg).size(), 2U);
    EXPECT_NE(drawn("falling --what velocity --units cgs", "figure.svg"),
              drawn("falling --what velocity", "figure.svg"))
        << "the axis names the units";
    EXPECT_EQ(drawn("falling/energy.dat --what velocity", "figure.svg"),
              drawn("falling --what velocity", "figure.svg"));
}

TEST_F(PlotDecks, ForcesAreDrawnOverDisplacementsWhereABodyIsDriven) {
    fs::create_directories(folder_ / "deck");
    fs::copy(shipped_deck("controlled_segment_displacement") / "in_gm.dat", folder_ / "deck" / "in_gm.dat");
    write("deck/in_bc.dat", "0 0 20000 100 10\n1\n2\n1\n2 1 3.0 1 0.0 1 0.0\n");
    ASSERT_EQ(
        std::system(fmt::format("cd '{}' && '{}' run -q deck -o driven", folder_.string(), CRACKLE_PROGRAM).c_str()),
        0);
    EXPECT_EQ(frames_of(drawn("driven", "figure.svg")).size(), 3U)
        << "energy, displacement along the drive, force over it; nothing moves up or down";
}

TEST_F(PlotDecks, RefusesWhatARunHasNot) {
    write_sample_results(folder_ / "pulled", SampleTest{});
    expect_refused("wave pulled -o figure.pdf",
                   "found the run of a deck and pulled, expected only runs of decks, or only tests");
    expect_refused("wave -o figure.pdf --what strain",
                   "--what: found 'strain', expected energy, displacement, height, velocity, force, curve or all "
                   "for the run of a deck");
    expect_refused("wave -o figure.pdf --bodies 12",
                   "--bodies: found 12, expected a body for which the run of wave wrote rows: 11, 13, 15, 17");
    expect_refused("falling -o figure.pdf --what displacement",
                   "falling: found no rows in f-d_curve.dat, expected rows of the bodies");
    expect_refused("wave -o figure.pdf --what energy --bodies 11", "--bodies: found with --what energy");
    expect_refused("wave -o figure.pdf --at end", "--at: found with runs of decks");
    expect_refused("wave -o figure.pdf --units feet", "--units: found 'feet', expected one of si, cgs, mm-g-s");
    expect_refused("wave falling -o figure.pdf --labels one", "--labels: found 1 name, expected 2");
    write("wave/energy.dat", "0 1 2 three\n");
    expect_refused("wave -o figure.pdf", "wave/energy.dat:1: enka: found 'three'");
}

}  // namespace
}  // namespace crackle
