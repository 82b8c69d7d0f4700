// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the record of broken bonds of a deck run: one row per break, and the number of bonds.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "solver/demseg/deck_run.hpp"
#include "solver/demseg/read_outputs.hpp"
#include "solver/measure/breaks.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using namespace testing;

/// The guide's chain pulled at one end at ten times the speed, so that its bonds break at different times.
class Breaks : public ::testing::Test {
  protected:
    static constexpr std::int64_t steps = 4000;

    Breaks() {
        std::filesystem::create_directories(scratch_ / "deck");
        for (const char* name : {"in_gm.dat", "in_cf0.dat"})
            std::filesystem::copy_file(shipped_deck("chain_pulled") / name, scratch_ / "deck" / name);
        std::ofstream(scratch_ / "deck" / "in_bc.dat")
            << "3 0 2000 200 10\n2\n1 20\n2\n1 1 0 1 0 1 0\n20 1 4.2 1 0 1 0\n";
    }
    /// Runs the deck. @return the folder of its outputs
    std::filesystem::path run(const std::string& from, const std::string& to, std::int64_t count,
                              bool overwrite = false) const {
        DeckOptions options;
        options.folder = scratch_ / from;
        options.output = scratch_ / to;
        options.goes_on = from != "deck";
        options.steps = count;
        options.overwrite = overwrite;
        DeckRun(options).run();
        return scratch_ / to;
    }
    /// Lines after the header.
    static std::vector<std::string> rows(const std::filesystem::path& folder) {
        std::ifstream in(folder / "events.csv");
        std::vector<std::string> lines;
        std::string line;
        EXPECT_TRUE(std::getline(in, line));
        EXPECT_EQ(line + '\n', breaks_header());
        while (std::getline(in, line)) lines.push_back(line);
        return lines;
    }
    /// The second field of a row.
    static double step_of(const std::string& row) { return std::stod(row.substr(row.find(',') + 1)); }

    ScratchFolder scratch_;
};

TEST_F(Breaks, AreTheBondsLostBetweenTwoOutputs) {
    const std::filesystem::path out = run("deck", "out", steps);
    const std::vector<std::string> breaks = rows(out);
    const Rows bonds = read_rows(out / "bonds.dat");
    ASSERT_EQ(bonds.size(), 1u + steps / 10);
    EXPECT_EQ(bonds.front(), (std::vector<double>{0.0, 19.0, 0.0}));
    std::size_t counted = 0, outputs_with_some = 0;
    for (const std::vector<double>& row : bonds) {
        const std::size_t before = counted;
        while (counted < breaks.size() && step_of(breaks[counted]) <= row[0]) ++counted;
        EXPECT_EQ(row[2], static_cast<double>(counted)) << "broken up to step " << row[0];
        EXPECT_EQ(row[1] + row[2], 19.0) << row[0];
        outputs_with_some += counted > before ? 1 : 0;
    }
    fmt::print("  {} breaks, in {} intervals between outputs\n", breaks.size(), outputs_with_some);
    EXPECT_EQ(counted, breaks.size());
    EXPECT_GE(outputs_with_some, 3u);

    // Each contact that has lost its back-tension must have a row.
    const std::vector<DeckFrame> frames = read_frames(out / "cont2.dat");
    for (const DeckFrame& frame : frames) {
        const auto bonded = static_cast<double>(
            std::ranges::count_if(frame.rows, [](const std::vector<double>& row) { return row[7] != 0.0; }));
        const auto broken = static_cast<double>(
            std::ranges::count_if(breaks, [&](const std::string& row) { return step_of(row) <= frame.step; }));
        EXPECT_EQ(bonded, 19.0 - broken) << "step " << frame.step;
    }
}

TEST_F(Breaks, OfTwoPartsAreThoseOfTheRunInOne) {
    const std::vector<std::string> whole = rows(run("deck", "whole", steps));
    ASSERT_GE(whole.size(), 3u);
    // A part that ends at a break: both parts find the break, but only one writes it.
    const auto cut = static_cast<std::int64_t>(step_of(whole[1]));
    for (const std::int64_t length : {cut - 1, cut, cut + 1}) {
        const std::filesystem::path first = run("deck", "first", length, true);
        const std::filesystem::path second = run("first", "second", steps - length, true);
        EXPECT_EQ(read_file(first / "events.csv") + read_file(second / "events.csv"),
                  read_file(scratch_ / "whole" / "events.csv"))
            << "cut at " << length;
        EXPECT_EQ(read_file(first / "bonds.dat") + read_file(second / "bonds.dat"),
                  read_file(scratch_ / "whole" / "bonds.dat"))
            << "cut at " << length;
        const DeckBreaks later = DeckFrames(second).breaks();
        EXPECT_EQ(later.names_line, 0);
        EXPECT_TRUE(later.table.starts_with(breaks_header()));
        EXPECT_TRUE(later.table.ends_with(read_file(second / "events.csv")));
        // Without the state file, the breaks of the last step are found again from the text files, and those of the
        // next step are written.
        std::filesystem::remove(first / "new_state.bin");
        const std::string rest = read_file(run("first", "by text", 1, true) / "events.csv");
        const auto expected = std::ranges::count(whole, static_cast<double>(length + 1), step_of);
        EXPECT_EQ(std::ranges::count(rest, '\n'), expected) << "cut at " << length << ": " << rest;
    }
}

TEST_F(Breaks, BehindTheStepFromWhichARunGoesOnAreDropped) {
    const std::vector<std::string> whole = rows(run("deck", "whole", steps));
    const auto cut = static_cast<std::int64_t>(step_of(whole[1])) + 1;
    const std::filesystem::path folder = run("deck", "part", cut);
    const std::size_t before = rows(folder).size();
    // Files as left by a killed part, with an incomplete last line.
    std::ofstream(folder / "events.csv", std::ios::app) << whole[before] << '\n' << whole[before + 1].substr(0, 25);
    DeckOptions options;
    options.folder = folder;
    options.goes_on = true;
    options.steps = steps - cut;
    DeckRun(options).run();
    EXPECT_EQ(rows(folder), whole);
}

TEST_F(Breaks, OfAnotherProgramAreNotTakenForOurs) {
    const std::filesystem::path folder = run("deck", "out", 100);
    std::ofstream(folder / "events.csv") << "when,where\n1,2\n";
    EXPECT_NE(refusal([&] { DeckFrames{folder}; }).find("events.csv:1: found 'when,where'"), std::string::npos);
    DeckOptions options;
    options.folder = folder;
    options.goes_on = true;
    options.steps = 10;
    EXPECT_NE(refusal([&] { DeckRun(options).run(); }).find("events.csv:1: found 'when,where'"), std::string::npos);
}

}  // namespace
}  // namespace crackle
