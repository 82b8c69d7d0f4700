// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a deck run in several parts gives the same results as a single run: identical bytes with the state file,
// and agreement to 1e-9 from the text files alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_state.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using namespace testing;

struct SplitCase {
    const char* deck;
    std::int64_t steps;       // number of steps of the whole run
    std::int64_t text_steps;  // the same if only text files are passed on: fewer, since last digits soon differ
    // Whether dt of the deck is replaced by 0. Text files pass on the step in use, and nothing lowers it afterwards.
    bool derived_step = false;
};

std::ostream& operator<<(std::ostream& out, const SplitCase& c) {
    return out << c.deck << (c.derived_step ? ", dt 0" : "");
}

class SplitRun : public ::testing::TestWithParam<SplitCase> {
  protected:
    static DeckOptions part(const std::filesystem::path& from, const std::filesystem::path& to, std::int64_t steps,
                            bool goes_on) {
        DeckOptions options;
        options.folder = from;
        options.output = to;
        options.steps = steps;
        options.goes_on = goes_on;
        return options;
    }

    /// The shipped deck, or a copy of it with dt 0.
    std::filesystem::path deck() const {
        const std::filesystem::path shipped = shipped_deck(GetParam().deck);
        if (!GetParam().derived_step) return shipped;
        const auto copy = scratch_ / "deck";
        std::filesystem::create_directories(copy);
        for (const auto& file : std::filesystem::directory_iterator(shipped)) {
            const std::string name = file.path().filename().string();
            if (!name.starts_with("in_")) continue;
            std::string text = read_file(file.path());
            if (name == "in_gm.dat") {  // dt is the first value of the second line
                const std::size_t at = text.find('\n') + 1;
                text.replace(at, text.find(' ', at) - at, "0");
            }
            std::ofstream(copy / name) << text;
        }
        return copy;
    }

    /// Three cuts in ascending order, none at an end of the run.
    std::vector<std::int64_t> lengths(std::int64_t steps) const {
        std::mt19937_64 random(std::hash<std::string>{}(GetParam().deck));
        std::vector<std::int64_t> cuts{0, steps};
        while (cuts.size() < 5) {
            const auto cut = 1 + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(steps - 1));
            if (std::find(cuts.begin(), cuts.end(), cut) == cuts.end()) cuts.push_back(cut);
        }
        std::sort(cuts.begin(), cuts.end());
        std::vector<std::int64_t> parts;
        for (std::size_t k = 1; k < cuts.size(); ++k) parts.push_back(cuts[k] - cuts[k - 1]);
        return parts;
    }

    /// Runs the parts one after another, each in its own folder. @return the folders
    std::vector<std::filesystem::path> run_parts(std::int64_t steps, bool with_state) {
        std::vector<std::filesystem::path> folders;
        std::filesystem::path from = deck();
        for (const std::int64_t length : lengths(steps)) {
            const auto to = scratch_ / ("part" + std::to_string(folders.size()));
            DeckRun run(part(from, to, length, !folders.empty()));
            EXPECT_TRUE(folders.empty() || run.notices().empty());
            run.run();
            if (!with_state) std::filesystem::remove(to / "new_state.bin");
            folders.push_back(to);
            from = to;
        }
        return folders;
    }

    ScratchFolder scratch_;
};

TEST_P(SplitRun, HasTheBytesOfTheRunInOne) {
    const auto whole = scratch_ / "whole";
    DeckRun(part(deck(), whole, GetParam().steps, false)).run();
    const auto parts = run_parts(GetParam().steps, true);
    for (const char* name : deck_output_names) {
        std::string joined;
        for (const auto& folder : parts) joined += read_file(folder / name);
        EXPECT_TRUE(joined == read_file(whole / name)) << name << " of the parts, put together";
        EXPECT_FALSE(std::string(name) != "f-d_curve.dat" && joined.empty()) << name;
    }
    for (const char* name : {"new_in_gm.dat", "new_in_bc.dat", "new_in_cf.dat", "new_in_cf0.dat", "new_state.bin"}) {
        EXPECT_TRUE(read_file(parts.back() / name) == read_file(whole / name)) << name;
    }
}

TEST_P(SplitRun, FromTheTextFilesAloneAgreesTo1e9) {
    const auto whole = scratch_ / "whole";
    const std::int64_t steps = GetParam().text_steps;
    DeckRun(part(deck(), whole, steps, false)).run();
    const auto parts = run_parts(steps, false);
    const Scene expected = read_geometry(whole / "new_in_gm.dat"), got = read_geometry(parts.back() / "new_in_gm.dat");
    double error = 0.0, extent = 0.0, fastest = 1e-300, speed_error = 0.0;
    const auto compare = [&](Vec2 a, Vec2 b) {
        error = std::max(error, norm(a - b));
        extent = std::max(extent, norm(a));
    };
    for (std::size_t k = 0; k < expected.circles.size(); ++k)
        compare(expected.circles[k].centre, got.circles[k].centre);
    for (std::size_t k = 0; k < expected.vertices.size(); ++k) compare(expected.vertices[k], got.vertices[k]);
    for (std::size_t k = 0; k < expected.bodies.size(); ++k) {
        fastest = std::max(fastest, norm(expected.bodies[k].velocity));
        speed_error = std::max(speed_error, norm(expected.bodies[k].velocity - got.bodies[k].velocity));
    }
    EXPECT_TRUE(within("positions over the extent", error / extent, 0.0, 1e-9));
    EXPECT_TRUE(within("velocities over the largest", speed_error / fastest, 0.0, 1e-9));
}

/// Two parts of a deck in one folder; the second is stopped at each moment while it replaces the files for the next
/// part.
class StoppedDeck : public ::testing::Test {
  protected:
    static constexpr const char* next_files[] = {"new_in_gm.dat", "new_in_bc.dat", "new_in_cf.dat", "new_in_cf0.dat",
                                                 "new_state.bin"};

    static void run(const std::filesystem::path& folder, bool goes_on) {
        DeckOptions options;
        options.folder = goes_on ? folder : shipped_deck("embankment");
        options.output = folder;
        options.steps = 300;
        options.goes_on = goes_on;
        DeckRun(options).run();
    }

    ScratchFolder scratch_;
};

TEST_F(StoppedDeck, WhileItsFilesWereReplacedGoesOnWithTheBytesOfOneThatWasNot) {
    const auto undisturbed = scratch_ / "undisturbed", first = scratch_ / "first";
    run(undisturbed, false);
    std::filesystem::copy(undisturbed, first);
    run(undisturbed, true);
    FileSet second;
    for (const char* name : next_files) second.emplace_back(name, read_file(undisturbed / name));
    const auto after_second = scratch_ / "after_second";
    std::filesystem::copy(undisturbed, after_second);
    run(undisturbed, true);
    for (std::size_t replaced = 0; replaced <= second.size(); ++replaced) {
        const auto stopped = scratch_ / ("stopped" + std::to_string(replaced));
        std::filesystem::copy(after_second, stopped);
        for (std::size_t k = replaced; k < second.size(); ++k)
            std::filesystem::copy_file(first / second[k].first, stopped / second[k].first,
                                       std::filesystem::copy_options::overwrite_existing);
        write_journal(stopped / "new_files.journal", second);
        run(stopped, true);
        for (const auto& file : std::filesystem::directory_iterator(undisturbed)) {
            const auto name = file.path().filename();
            EXPECT_TRUE(read_file(stopped / name) == read_file(file.path())) << replaced << ": " << name;
        }
        EXPECT_FALSE(std::filesystem::exists(stopped / "new_files.journal"));
    }
}

TEST_F(StoppedDeck, ThatWasKilledGoesOnFromWhatItSavedLast) {
    struct Stop {};
    const auto whole = scratch_ / "whole", killed = scratch_ / "killed";
    run(whole, false);
    DeckOptions options;
    options.folder = shipped_deck("embankment");
    options.output = killed;
    options.steps = 300;
    options.save_interval = 0.0;  // whenever the clock is looked at, every 64 steps
    const auto die = [](const World& world) {
        if (world.stepping.steps == 200) throw Stop();
        return true;
    };
    EXPECT_THROW(DeckRun(options).run(die), Stop);
    DeckOptions rest;
    rest.folder = killed;
    rest.goes_on = true;
    rest.steps = 300 - 192;
    DeckRun second(rest);
    EXPECT_EQ(second.first_step(), 192);
    second.run();
    for (const auto& file : std::filesystem::directory_iterator(whole)) {
        const auto name = file.path().filename();
        EXPECT_TRUE(read_file(killed / name) == read_file(file.path())) << name;
    }
}

TEST_F(StoppedDeck, WhoseFilesAreCopiedByHandIsToldToCopyThemAgain) {
    const auto folder = scratch_ / "deck";
    run(folder, false);
    FileSet files;
    for (const char* name : next_files) files.emplace_back(name, read_file(folder / name));
    write_journal(folder / "new_files.journal", files);
    for (const char* name : {"in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat"})
        std::filesystem::copy_file(folder / (std::string("new_") + name), folder / name);
    DeckOptions options;
    options.folder = folder;
    options.output = scratch_ / "next";
    EXPECT_THROW(DeckRun{options}, InputError);
    EXPECT_NO_THROW(DeckRun{options}) << "reported once; the results are then complete";
}

TEST_F(StoppedDeck, TwoRunsDoNotShareAFolder) {
    const auto folder = scratch_ / "deck";
    run(folder, false);
    DeckOptions options;
    options.folder = folder;
    options.steps = 300;
    options.goes_on = true;
    {
        DeckRun first(options);
        EXPECT_THROW(DeckRun{options}, InputError) << "from the moment its files were read";
        options.output = scratch_ / "apart";
        EXPECT_THROW(DeckRun{options}, InputError) << "its files are about to be replaced";
        first.run();
    }
    const DeckRun one(options);
    options.output = scratch_ / "apart too";
    EXPECT_NO_THROW(DeckRun{options}) << "two runs may continue from one folder into others";
}

TEST_F(StoppedDeck, ALinkAmongItsOutputsIsRefusedAndNothingIsCutOff) {
    const auto folder = scratch_ / "deck";
    run(folder, false);
    std::filesystem::remove(folder / "energy.dat");
    std::filesystem::create_symlink("/proc/self/mem", folder / "energy.dat");
    const std::string frames = read_file(folder / "output.dat");
    try {
        run(folder, true);
        ADD_FAILURE() << "wrote through a link";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("energy.dat: found a symbolic link"), std::string::npos)
            << error.what();
    }
    EXPECT_TRUE(read_file(folder / "output.dat") == frames);
}

TEST(DeckThreads, DoNotChangeAByte) {
    const ScratchFolder scratch;
    const auto run = [&](int threads) {
        DeckOptions options;
        options.folder = shipped_deck("embankment");
        options.output = scratch / std::to_string(threads);
        options.steps = 1000;
        options.threads = threads;
        DeckRun(options).run();
        return options.output;
    };
    const auto one = run(1), three = run(3);
    for (const char* name :
         {"output.dat", "cont.dat", "energy.dat", "f-d_curve.dat", "new_in_gm.dat", "new_in_cf.dat", "new_state.bin"}) {
        EXPECT_TRUE(read_file(one / name) == read_file(three / name)) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    ShippedDecks, SplitRun,
    ::testing::Values(SplitCase{"circle", 20000, 20000}, SplitCase{"clump", 20000, 20000},
                      SplitCase{"segment", 20000, 20000}, SplitCase{"triangle", 20000, 20000},
                      SplitCase{"controlled_segment_displacement", 20000, 20000},
                      SplitCase{"controlled_segment_force", 20000, 20000}, SplitCase{"wave_chain", 400, 400},
                      SplitCase{"rebound", 300000, 300000}, SplitCase{"slope_k1", 7000, 7000},
                      SplitCase{"slope_k100", 70000, 70000}, SplitCase{"embankment", 10000, 600},
                      SplitCase{"repose", 2000, 100}, SplitCase{"chain_hanging", 500000, 20000},
                      SplitCase{"chain_pulled", 20000, 16000}, SplitCase{"random_packing", 20000, 100},
                      SplitCase{"triangle", 20000, 20000, true}, SplitCase{"slope_k1", 3000, 3000, true},
                      SplitCase{"embankment", 4000, 90, true}, SplitCase{"chain_pulled", 16000, 16000, true}),
    [](const auto& deck) { return deck.param.deck + std::string(deck.param.derived_step ? "_derived_step" : ""); });

}  // namespace
}  // namespace crackle
