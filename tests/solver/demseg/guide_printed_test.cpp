// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the decks as printed in the guide, including notes (guide_printed/; those in Japanese in UTF-8, and in CP932
// with DOS line ends). Each must run like the shipped deck without notes, and its result must be listed beside the
// guide's in specimens/demseg/README.md. Files that the guide does not repeat are those of an earlier example.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <tuple>

#include "solver/base/errors.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/files/read_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using namespace testing;

fs::path printed(const std::string& file) {
    return fs::path(CRACKLE_SOURCE_DIR) / "tests/solver/demseg/guide_printed" / file;
}

/// Assembles decks in a temporary folder.
class GuidePrinted : public ::testing::Test {
  protected:
    GuidePrinted() { fs::create_directories(deck_); }

    void take(const fs::path& file, const std::string& name) const {
        fs::copy_file(file, deck_ / name, fs::copy_options::overwrite_existing);
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(deck_ / name) << text; }

    DeckOptions options(const fs::path& folder, const std::string& output) const {
        DeckOptions options;
        options.folder = folder;
        options.output = scratch_ / output;
        return options;
    }
    /// Runs the deck. @return folder of its outputs
    fs::path run() const {
        DeckRun(options(deck_, "out")).run();
        return scratch_ / "out";
    }

    ScratchFolder scratch_;
    fs::path deck_ = scratch_ / "deck";
};

struct Example {
    const char *name, *geometry, *boundary;  // folders of the printed files
    const char* shipped;                     // the deck without notes
    std::int64_t steps;
    std::vector<const char*> ignored;  // expected notices, for in_bc.dat and then in_gm.dat
};

std::ostream& operator<<(std::ostream& out, const Example& example) { return out << example.name; }

class PrintedExample : public GuidePrinted, public ::testing::WithParamInterface<Example> {};

TEST_P(PrintedExample, HasTheBytesOfTheDeckWithoutNotes) {
    take(printed(std::string(GetParam().geometry) + "/in_gm.dat"), "in_gm.dat");
    take(printed(std::string(GetParam().boundary) + "/in_bc.dat"), "in_bc.dat");
    DeckOptions typed = options(deck_, "typed"), plain = options(shipped_deck(GetParam().shipped), "plain");
    typed.steps = plain.steps = GetParam().steps;
    DeckRun run(typed), plain_run(plain);
    std::vector<std::string> ignored;
    for (const std::string& notice : run.notices()) {
        if (notice.find("numbers after the last value") != std::string::npos) ignored.push_back(notice);
    }
    ASSERT_EQ(ignored.size(), GetParam().ignored.size());
    for (std::size_t k = 0; k < ignored.size(); ++k)
        EXPECT_NE(ignored[k].find(GetParam().ignored[k]), std::string::npos) << ignored[k];
    run.run();
    plain_run.run();
    for (const char* name : deck_output_names)
        EXPECT_TRUE(read_file(typed.output / name) == read_file(plain.output / name)) << name;
}

const std::vector<const char*> controlled{
    "in_bc.dat: numbers after the last value of a READ are ignored, as DEMseg "
    "does: '2' in line 4, '3.0d0' in line 5, '0.0d0' in line 6 and 1 more;",
    "in_gm.dat: numbers after the last value of a READ are ignored, as DEMseg "
    "does: '0' in line 6;"};
const std::vector<const char*> geometry_alone{controlled[1]};

INSTANTIATE_TEST_SUITE_P(OfTheGuide, PrintedExample,
                         ::testing::Values(Example{"circle", "circle", "circle", "circle", 20000, {}},
                                           Example{"clump", "clump", "circle", "clump", 20000, {}},
                                           Example{"segment", "segment", "circle", "segment", 20000, {}},
                                           Example{"triangle", "triangle", "circle", "triangle", 20000, {}},
                                           Example{"displacement", "displacement", "displacement",
                                                   "controlled_segment_displacement", 20000, controlled},
                                           Example{"displacement_cp932", "displacement_cp932", "displacement_cp932",
                                                   "controlled_segment_displacement", 20000, controlled},
                                           Example{"curve", "displacement", "curve", "controlled_segment_force", 20000,
                                                   geometry_alone},
                                           Example{"curve_cp932", "displacement_cp932", "curve_cp932",
                                                   "controlled_segment_force", 20000, geometry_alone},
                                           Example{"repose", "repose", "repose", "repose", 20, {}},
                                           Example{"repose_cp932", "repose_cp932", "repose_cp932", "repose", 20, {}}),
                         [](const auto& example) { return std::string(example.param.name); });

/// Checks that this number is in the last column of the table in specimens/demseg/README.md.
::testing::AssertionResult stands_in_table(const std::string& example, const std::string& guide,
                                           const std::string& ours) {
    const std::string row = fmt::format("| {} | {} |", guide, ours);
    fmt::print("  {}: the guide {}, here {}\n", example, guide, ours);
    std::istringstream lines(read_file(shipped_deck("README.md")));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("| " + example + " |") && line.ends_with(row)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "specimens/demseg/README.md has no row of " << example << " that ends in "
                                         << row;
}

TEST_F(GuidePrinted, LimitOfTheStepAndTopOfABounce) {
    take(printed("circle/in_gm.dat"), "in_gm.dat");
    take(printed("circle/in_bc.dat"), "in_bc.dat");
    const double limit = DeckRun(options(deck_, "unused")).world().stepping.step_bound;
    EXPECT_TRUE(agrees("limit of the step, s", limit, 1.123e-3, 2e-3)) << "the guide rounds the exponent m";
    EXPECT_TRUE(stands_in_table("limit of the step of ex01-1, s", "1.123e-3", fmt::format("{:.3f}e-3", 1e3 * limit)));
    double top = 0.0;
    for (const DeckFrame& frame : read_frames(run() / "output.dat")) {
        if (frame.step > 5000.0) top = std::max(top, frame.rows[0][3]);  // after the bounce
    }
    EXPECT_TRUE(within("top", top, 5.0, 0.01));
    EXPECT_TRUE(stands_in_table("top of a bounce of ex01-1, of frames 100 steps apart", "5 (no loss)",
                                fmt::format("{:.2f}", top)));
}

TEST_F(GuidePrinted, EnergyIsConservedBySegmentsAndClumps) {
    for (const auto& [name, tolerance] : {std::pair{"clump", 0.01}, {"segment", 0.05}, {"triangle", 0.01}}) {
        take(printed(std::string(name) + "/in_gm.dat"), "in_gm.dat");
        take(printed("circle/in_bc.dat"), "in_bc.dat");
        double error = 0.0, kinetic = 0.0;
        DeckOptions again = options(deck_, name);
        DeckRun(again).run();
        for (const auto& row : read_rows(again.output / "energy.dat")) {
            error = std::max(error, std::abs(row[8]));
            kinetic = std::max(kinetic, row[2]);
        }
        EXPECT_TRUE(within("err over the largest kinetic energy", error / kinetic, 0.0, tolerance)) << name;
        EXPECT_TRUE(stands_in_table(fmt::format("err of energy.dat, {}", name), "conserved",
                                    fmt::format("{:.1g} of the kinetic energy", error / kinetic)));
    }
}

TEST_F(GuidePrinted, ControlledSegmentMovesAsPrinted) {
    take(printed("displacement_cp932/in_gm.dat"), "in_gm.dat");
    take(printed("displacement_cp932/in_bc.dat"), "in_bc.dat");
    const auto frames = read_frames(run() / "output.dat");
    const double way = frames.back().rows[1][1] - frames.front().rows[1][1];
    EXPECT_TRUE(within("final displacement", way, 3.0, 1e-12));
    EXPECT_TRUE(stands_in_table("final displacement of body 2", "3.0d0", fmt::format("{:.6g}", way)));

    take(printed("force/in_bc.dat"), "in_bc.dat");
    DeckRun(options(deck_, "force")).run();
    EXPECT_TRUE(read_rows(scratch_ / "force" / "f-d_curve.dat").empty()) << "npfd is 0";
    const auto pushed = read_frames(scratch_ / "force" / "output.dat");
    const double mass = 1.25;
    EXPECT_TRUE(within("x = x0 + F/m dt² n(n+1)/2 at step 100", pushed[1].rows[1][1],
                       -3.0 + 1e4 / mass * 4e-10 * 100.0 * 101.0 / 2.0, 1e-12));

    take(printed("curve_cp932/in_bc.dat"), "in_bc.dat");
    DeckRun(options(deck_, "curve")).run();
    const Rows rows = read_rows(scratch_ / "curve" / "f-d_curve.dat");
    ASSERT_GE(rows.size(), 3u);
    EXPECT_TRUE(within("x at step 10", rows[1][3], -2.99982, 5.1e-6));
    EXPECT_TRUE(within("x at step 20", rows[2][3], -2.99933, 5.1e-6));
    EXPECT_TRUE(stands_in_table("x of body 2 at steps 1, 10, 20 of f-d_curve.dat", "-3, -2.99982, -2.99933",
                                fmt::format("{:.6g}, {:.6g}, {:.6g}", rows[0][3], rows[1][3], rows[2][3])));
}

TEST_F(GuidePrinted, RandomCirclesAreSoMany) {
    take(printed("repose_cp932/in_gm.dat"), "in_gm.dat");
    take(printed("repose_cp932/in_bc.dat"), "in_bc.dat");
    const std::size_t circles = DeckRun(options(deck_, "unused")).world().bodies.size();
    EXPECT_EQ(circles, 582u);
    EXPECT_TRUE(stands_in_table("circles made at random", "582", fmt::format("{}", circles)));
}

// The guide omits circles 3 to 582; the numbers in line 6 count those that remain.
TEST_F(GuidePrinted, SlopeGoesOnFromItsStepAndHoldsItsWall) {
    take(printed("slope/in_gm.dat"), "in_gm.dat");
    take(printed("slope/in_bc.dat"), "in_bc.dat");
    const auto frames = read_frames(run() / "output.dat");
    EXPECT_TRUE(stands_in_table("first and last step of the slope", "12000, 12000 + 100000",
                                fmt::format("{}, {}", frames.front().step, frames.back().step)));
    EXPECT_EQ(frames.front().step, 12000.0);
    EXPECT_EQ(frames.back().step, 112000.0);
    const std::vector<double> toe{583.0, 80.1, -0.1, 80.1, 4.0};
    for (std::size_t k = 0; k < toe.size(); ++k)
        EXPECT_TRUE(within("the toe, controlled by 0", frames.back().rows.back()[k], toe[k], 1e-12));
}

/// The guide's chain of 20 circles (its figure 10), for which it prints no in_gm.dat.
class GuidePrintedChain : public GuidePrinted {
  protected:
    GuidePrintedChain() { take(shipped_deck("chain_pulled") / "in_gm.dat", "in_gm.dat"); }

    /// Runs one very short step, in which nothing moves, and renames its files as described in the guide.
    void make_in_cf0() const {
        std::string shorter = read_file(deck_ / "in_gm.dat");
        const std::string step = "2.0d-5";
        write("in_gm.dat", shorter.replace(shorter.find(step), step.size(), "2.0d-14"));
        write("in_bc.dat", "0 0 1 1 1\n0\n0\n");
        const fs::path out = run();
        for (const char* name : {"in_cf0.dat", "in_cf.dat"}) take(out / (std::string("new_") + name), name);
        take(shipped_deck("chain_pulled") / "in_gm.dat", "in_gm.dat");
        fs::remove_all(out);
    }

    /// Circles 1 and 2 are held and circle 20 is pulled, the guide's first way of loading.
    static constexpr const char* held = "1\n20\n3\n1 1 0.0 1 0.0 1 0.0\n2 1 0.0 1 0.0 1 0.0\n20 1 4.2 1 0.0 1 0.0\n";

    static double largest_force(const fs::path& out) {
        double largest = 0.0;
        for (const auto& row : read_rows(out / "f-d_curve.dat"))
            largest = std::max(largest, std::hypot(row[2], row[4]));
        return largest;
    }
};

TEST_F(GuidePrintedChain, DoesNotMoveOnceItsBackTensionsAreRead) {
    make_in_cf0();
    std::istringstream made(read_file(deck_ / "in_cf0.dat"));
    int id = 0, count = 0, other = 0;
    double tension = 0.0;
    made >> id >> count >> other >> tension;
    EXPECT_EQ(std::tuple(id, count, other), std::tuple(1, 1, 2)) << "the guide's first lines: 1 1, 2 -20000000.0000000";
    EXPECT_TRUE(agrees("back-tension", tension, -2e7, 1e-8));
    EXPECT_TRUE(stands_in_table("back-tension of the chain", "-20000000.0000000", fmt::format("{:.7f}", tension)));
    take(printed("chain/in_bc.dat"), "in_bc.dat");
    const auto frames = read_frames(run() / "output.dat");
    double moved = 0.0;
    for (std::size_t k = 0; k < 20; ++k)
        moved = std::max(moved, std::abs(frames.back().rows[k][2] - frames.front().rows[k][2]));
    EXPECT_TRUE(within("largest movement in 10000 steps", moved, 0.0, 1e-9));
    EXPECT_TRUE(stands_in_table("movement of the chain with walls removed", "none", moved < 1e-9 ? "none" : "some"));
}

TEST_F(GuidePrintedChain, IsLoadedByBodiesThatTouchEachOther) {
    make_in_cf0();
    write("in_bc.dat", std::string("3 1 20000 200 10\n") + held);
    DeckRun run(options(deck_, "out"));
    run.run();
    const double strength = largest_force(scratch_ / "out");
    EXPECT_TRUE(agrees("strength", strength, 2e7, 0.01));
    EXPECT_TRUE(stands_in_table("strength of the chain, bodies 1 and 2 held", "2e7", fmt::format("{:.3g}", strength)));
    EXPECT_GE(run.world().bonds.broken, 17);
}

TEST_F(GuidePrintedChain, GoesOnFromContactsOfBodiesThatAreControlledNow) {
    make_in_cf0();
    for (const bool bonded : {false, true}) {
        if (bonded) {
            write("in_bc.dat", "3 0 1 1 1\n0\n0\n");
            DeckRun(options(deck_, "first")).run();
            take(scratch_ / "first/new_in_cf.dat", "in_cf.dat");
        }
        write("in_bc.dat", std::string("1 1 20000 200 10\n") + held);
        DeckRun run(options(deck_, bonded ? "bonded" : "unbonded"));
        EXPECT_EQ(run.first_step(), 1);
        EXPECT_GE(run.world().bonds.initial, bonded ? 18 : 0);
        run.run();
        if (bonded) {
            EXPECT_TRUE(agrees("strength", largest_force(scratch_ / "bonded"), 2e7, 0.01));
        }
    }
}

TEST_F(GuidePrintedChain, StillRefusesContactsThatCannotBe) {
    make_in_cf0();
    std::string lists = "1 1\n3 -2e7\n2 0\n3 1\n1 -2e7\n";
    for (int id = 4; id <= 20; ++id) lists += fmt::format("{} 0\n", id);
    write("in_cf0.dat", lists);
    write("in_bc.dat", std::string("3 1 20000 200 10\n") + held);
    EXPECT_NE(refusal([&] { DeckRun{options(deck_, "out")}; }).find("bodies 1 and 3: found no contact"),
              std::string::npos)
        << "body 3 can move";
}

}  // namespace
}  // namespace crackle
