// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the folder of a deck run: its output files, continuing from them, and refusals.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_run.hpp"
#include "solver/demseg/deck_state.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using namespace testing;

class DeckFolder : public ::testing::Test {
  protected:
    DeckFolder() : folder_(scratch_ / "deck") {
        std::filesystem::create_directories(folder_);
        for (const char* name : {"in_gm.dat", "in_bc.dat"})
            std::filesystem::copy_file(shipped_deck("chain_pulled") / name, folder_ / name);
    }
    DeckOptions options(bool goes_on = false) const {
        DeckOptions result;
        result.folder = folder_;
        result.goes_on = goes_on;
        result.steps = 100;
        return result;
    }
    void edit(const std::string& name, const std::string& what, const std::string& by) const {
        std::string text = read_file(folder_ / name);
        const std::size_t at = text.find(what);
        ASSERT_NE(at, std::string::npos);
        std::ofstream(folder_ / name) << text.replace(at, what.size(), by);
    }

    ScratchFolder scratch_;
    std::filesystem::path folder_;
};

TEST_F(DeckFolder, BondsFromPresentOverlapsWhereBackTensionsAreAbsent) {
    DeckRun run(options());
    EXPECT_EQ(run.world().bonds.initial, 19);
    ASSERT_EQ(run.notices().size(), 1u);
    EXPECT_NE(run.notices()[0].find("19 bonds were made from the current overlaps"), std::string::npos);
}

TEST_F(DeckFolder, OutputsAreNeverOverwrittenUnasked) {
    DeckRun(options()).run();
    const std::string before = read_file(folder_ / "energy.dat");
    EXPECT_NE(refusal([&] { DeckRun{options()}; }).find("found the output of an earlier run"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "energy.dat"), before);
    DeckOptions forced = options();
    forced.overwrite = true;
    DeckRun(forced).run();
    EXPECT_EQ(read_file(folder_ / "energy.dat"), before);
}

TEST_F(DeckFolder, GoingOnInPlaceAppends) {
    DeckRun(options()).run();
    DeckRun(options(true)).run();
    const Rows rows = read_rows(folder_ / "energy.dat");
    ASSERT_EQ(rows.size(), 21u);
    EXPECT_EQ(rows[10][0], 100.0);
    EXPECT_EQ(rows[20][0], 200.0);
}

TEST_F(DeckFolder, GoingOnDropsWhatAFailedPartHadWrittenBeyondItsBeginning) {
    // events.csv, which has no rows here, is tested in breaks_test.cpp.
    const std::array<const char*, 7> outputs{"output.dat",    "cont.dat",       "cont2.dat", "energy.dat",
                                             "f-d_curve.dat", "velocity_y.dat", "bonds.dat"};
    edit("in_bc.dat", "3 0 20000 200 10", "3 0 20000 50 10");
    DeckOptions whole = options();
    whole.output = scratch_ / "whole";
    whole.steps = 200;
    DeckRun(whole).run();
    for (const bool with_state : {true, false}) {
        DeckOptions first = options(), second = options(true);
        first.output = scratch_ / (with_state ? "state" : "text");
        second.folder = first.output;
        DeckRun(first).run();
        std::map<std::string, std::string> left;
        for (const char* name : {"new_in_gm.dat", "new_in_bc.dat", "new_in_cf.dat", "new_in_cf0.dat", "new_state.bin"})
            left[name] = read_file(first.output / name);
        DeckRun(second).run();  // the lost part: rows and frames up to step 200, the last one incomplete
        for (const auto& [name, text] : left) std::ofstream(first.output / name, std::ios::binary) << text;
        if (!with_state) std::filesystem::remove(first.output / "new_state.bin");
        for (const char* name : outputs) {
            std::filesystem::resize_file(first.output / name, std::filesystem::file_size(first.output / name) - 7);
            std::ofstream(first.output / name, std::ios::app) << "\n2";
        }
        DeckRun(second).run();
        for (const char* name : outputs) {
            if (with_state) {
                EXPECT_TRUE(read_file(first.output / name) == read_file(whole.output / name)) << name;
                continue;
            }
            const Rows expected = read_rows(whole.output / name), got = read_rows(first.output / name);
            ASSERT_EQ(got.size(), expected.size()) << name;
            for (std::size_t k = 0; k < got.size(); ++k) EXPECT_EQ(got[k][0], expected[k][0]) << name << ", row " << k;
        }
    }
}

TEST_F(DeckFolder, ARunInterruptedBeforeItsFirstStepHasTheRowOfItsBeginning) {
    DeckOptions whole = options();
    whole.output = scratch_ / "whole";
    DeckRun(whole).run();
    DeckRun(options()).run([](const World&) { return false; });
    DeckRun(options(true)).run([](const World&) { return false; });
    DeckRun(options(true)).run();
    for (const char* name : deck_output_names)
        EXPECT_TRUE(read_file(folder_ / name) == read_file(whole.output / name)) << name;
}

TEST_F(DeckFolder, AForeignOutputIsRefusedBeforeAnythingIsAppended) {
    DeckRun(options()).run();
    std::ofstream(folder_ / "energy.dat") << "once upon a time\n";
    DeckRun next(options(true));
    EXPECT_NE(refusal([&] { next.run(); }).find("energy.dat:1: found 'once"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "energy.dat"), "once upon a time\n");
    const std::string counts = "0 0 9223372036854775807 9223372036854775807";
    std::ofstream(folder_ / "output.dat") << counts << '\n';
    EXPECT_NE(refusal([&] { DeckRun(options(true)).run(); }).find("output.dat:1: found '" + counts.substr(0, 40)),
              std::string::npos);
}

TEST_F(DeckFolder, ADerivedStepIsHandedOnAsTheStepInUse) {
    edit("in_gm.dat", "2.0d-5", "0");
    DeckRun run(options());
    run.run();
    EXPECT_EQ(read_geometry(folder_ / "new_in_gm.dat").time_step, run.world().stepping.time_step);
    EXPECT_GT(run.world().stepping.time_step, 0.0);
}

TEST_F(DeckFolder, AStepThatThePileOutgrowsStopsTheRunWithItsOutputs) {
    // Two discs approach each other; the bound for a pair is 1/sqrt(2) of that for a single disc, 1.12e-3 s.
    std::ofstream(folder_ / "in_gm.dat") << "1 0 0\n0.9e-3 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0\n2 0 0\n"
                                            "1 1 1\n1 0 0\n1 2\n-2.125 0 0\n2 1 1\n-1 0 0\n1 2\n2.125 0 0\n";
    std::ofstream(folder_ / "in_bc.dat") << "0 0 200 100 10\n0\n0\n";
    DeckOptions longer = options();
    longer.steps = 200;
    DeckRun run(longer);
    try {
        run.run();
        FAIL() << "expected the run to be stopped";
    } catch (const UnstableRun& error) {
        const std::string text = error.what();
        fmt::print("  {}\n", text);
        EXPECT_NE(text.find("0.0009 s"), std::string::npos);
        EXPECT_NE(text.find("0.000792"), std::string::npos);
        EXPECT_EQ(error.step, run.world().stepping.steps);
    }
    const Rows rows = read_rows(folder_ / "energy.dat");
    ASSERT_GE(rows.size(), 2u);
    EXPECT_GT(rows.back()[0], static_cast<double>(run.world().stepping.steps) - 11.0);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "new_in_gm.dat"));
    longer.overwrite = true;
    longer.allow_unstable = true;
    EXPECT_NO_THROW(DeckRun(longer).run());
}

TEST_F(DeckFolder, BareSegmentsThatNoCornerCanTouchAreTold) {
    std::ofstream(folder_ / "in_gm.dat") << "1 0 0\n1e-5 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0\n0 2 0\n"
                                            "1 1 1\n0 0 0\n1 0 0\n5 0\n2 1 1\n0 0 0\n1 0 1\n5 1\n";
    std::ofstream(folder_ / "in_bc.dat") << "0 0 200 100 10\n0\n0\n";
    DeckRun run(options());
    ASSERT_EQ(run.notices().size(), 1u);
    EXPECT_NE(run.notices()[0].find("thick: at a thickness of 0"), std::string::npos) << run.notices()[0];
}

TEST_F(DeckFolder, RenamedFilesGoOnWithTheStateUnlessTheyWereEdited) {
    DeckRun(options()).run();
    for (const char* name : {"in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat"}) {
        std::filesystem::rename(folder_ / (std::string("new_") + name), folder_ / name);
    }
    DeckOptions next = options();
    next.output = scratch_ / "next";
    EXPECT_TRUE(DeckRun(next).notices().empty());
    edit("in_gm.dat", "0 0\n1\n", "0 -980\n1\n");
    DeckRun edited(next);
    ASSERT_EQ(edited.notices().size(), 1u);
    EXPECT_NE(edited.notices()[0].find("new_state.bin: ignored, because in_gm.dat has changed since"),
              std::string::npos);
    EXPECT_EQ(edited.first_step(), 100);
    EXPECT_EQ(edited.world().bonds.initial, 19);
}

TEST_F(DeckFolder, DamagedStateIsRefusedWithARemedy) {
    DeckRun(options()).run();
    const std::string bytes = read_file(folder_ / "new_state.bin");
    std::ofstream(folder_ / "new_state.bin") << bytes.substr(0, bytes.size() / 2);
    EXPECT_NE(refusal([&] { DeckRun{options(true)}; }).find("found a truncated state"), std::string::npos);
}

TEST_F(DeckFolder, AStateOfOtherBodiesThanItsGeometryIsRefusedWithARemedy) {
    DeckRun(options()).run();
    DeckTexts texts;
    for (std::size_t k = 0; k < texts.size(); ++k)
        texts[k] = read_file(folder_ / (std::string("new_") + deck_text_names[k]));
    std::vector<std::string> edited;
    std::optional<DeckState> state =
        load_deck_state(folder_ / "new_state.bin", texts, {true, true, true, true}, edited);
    ASSERT_TRUE(state.has_value());
    state->world.bodies.names[0].id = 4711;
    std::ofstream(folder_ / "new_state.bin", std::ios::binary) << save_deck_state(*state, texts);
    EXPECT_NE(refusal([&] { DeckRun{options(true)}; }).find("found a state whose bodies differ from its geometry"),
              std::string::npos);
    state->world.points.contact.pairs[0].body_i = 4711;  // there are only twenty bodies
    std::ofstream(folder_ / "new_state.bin", std::ios::binary) << save_deck_state(*state, texts);
    EXPECT_NE(refusal([&] { DeckRun{options(true)}; }).find("found parts that do not belong together"),
              std::string::npos);
}

TEST_F(DeckFolder, ContinuingWithoutContactsIsRefused) {
    edit("in_bc.dat", "3 0 ", "1 0 ");
    EXPECT_NE(refusal([&] { DeckRun{options()}; }).find("in_cf.dat: not found, expected it because jclid is 1"),
              std::string::npos);
}

TEST_F(DeckFolder, AnUnstableRunKeepsItsOutputsAndEndsThere) {
    edit("in_bc.dat", "20 1 4.2", "20 0 3e7");
    edit("in_bc.dat", "3 0 20000 200 10", "0 0 20000 200 1");
    DeckOptions longer = options();
    longer.steps = 300;  // after step 180 the last disc, unbonded, moves 0.2 per step and passes through the wall
    EXPECT_THROW(DeckRun(longer).run(), UnstableRun);
    EXPECT_GT(read_rows(folder_ / "energy.dat").size(), 101u);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "new_in_gm.dat"));
}

TEST_F(DeckFolder, AForceBeyondAllMeasureStopsTheRunBeforeARowOfIt) {
    DeckRun(options()).run();
    std::istringstream lines(read_file(folder_ / "new_in_cf.dat"));
    std::ostringstream edited;
    bool done = false;
    for (std::string line; std::getline(lines, line);) {
        int other = 0, element = 0, partner = 0, slid = 0;
        double shear = 0.0, tension = 0.0;
        std::istringstream words(line);
        if (!done && words >> other >> element >> partner >> shear >> tension >> slid) {
            line = fmt::format("{} {} {} 1e308 {} {}", other, element, partner, tension, slid);
            done = true;
        }
        edited << line << '\n';
    }
    ASSERT_TRUE(done);
    std::ofstream(folder_ / "new_in_cf.dat") << edited.str();
    for (const bool allow_unstable : {false, true}) {
        DeckOptions next = options(true);
        next.output = scratch_ / (allow_unstable ? "allowed" : "checked");
        next.allow_unstable = allow_unstable;
        DeckRun run(next);
        EXPECT_THROW(run.run(), UnstableRun);
        for (const char* name : deck_output_names)
            EXPECT_EQ(read_file(next.output / name).find("inf"), std::string::npos) << name;
        EXPECT_FALSE(std::filesystem::exists(next.output / "new_in_gm.dat"));
    }
}

TEST_F(DeckFolder, AnUnwritableFolderIsOneClearError) {
    std::ofstream(scratch_ / "occupied") << "a file";
    DeckOptions next = options();
    next.output = scratch_ / "occupied";
    EXPECT_NE(refusal([&] { DeckRun(next).run(); }).find("occupied: found a file, expected a folder"),
              std::string::npos);
}

}  // namespace
}  // namespace crackle
