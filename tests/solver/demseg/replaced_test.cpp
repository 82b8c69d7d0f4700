// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a deck run that replaces an earlier one. At whatever moment it is stopped, the folder contains all files of one
// of the two runs and none of the other.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/demseg/deck_folder.hpp"
#include "solver/demseg/deck_run.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/demseg/read_outputs.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "solver/world/checkpoint.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using namespace testing;

struct Killed {};
using Contents = std::map<std::string, std::string>;

class ReplacedDeck : public ::testing::Test {
  protected:
    static constexpr std::int64_t earlier_steps = 200, new_steps = 300;
    static constexpr const char* next_files[] = {"new_in_gm.dat", "new_in_bc.dat", "new_in_cf.dat", "new_in_cf0.dat",
                                                 "new_state.bin"};

    ReplacedDeck() {
        DeckRun(options(folder_, earlier_steps)).run();
        DeckRun(options(scratch_ / "new", new_steps)).run();
        earlier_ = contents(folder_);
        new_ = contents(scratch_ / "new");
    }

    static DeckOptions options(const fs::path& output, std::int64_t steps) {
        DeckOptions options;
        options.folder = shipped_deck("embankment");
        options.output = output;
        options.steps = steps;
        return options;
    }
    DeckOptions forced() const {
        DeckOptions options = this->options(folder_, new_steps);
        options.overwrite = true;
        return options;
    }
    DeckOptions going_on(std::int64_t steps) const {
        DeckOptions options;
        options.folder = folder_;
        options.goes_on = true;
        options.steps = steps;
        return options;
    }
    static Contents contents(const fs::path& folder) {
        Contents all;
        for (const auto& file : fs::directory_iterator(folder))
            all[file.path().filename().string()] = read_file(file.path());
        return all;
    }
    /// Files of the folder, except outputs that have not received their final names.
    Contents named() const {
        Contents all = contents(folder_);
        std::erase_if(all, [](const auto& file) { return file.first.ends_with(staged_suffix); });
        return all;
    }

    ScratchFolder scratch_;
    const fs::path folder_ = scratch_ / "deck";
    Contents earlier_, new_;
};

TEST_F(ReplacedDeck, IsWholeUntilTheNewRunCanBeGoneOnWith) {
    const auto die = [](const World& world) {
        if (world.stepping.steps == 250) throw Killed();
        return true;
    };
    EXPECT_THROW(DeckRun(forced()).run(die), Killed);
    EXPECT_TRUE(named() == earlier_);
    for (const char* name : deck_output_names) EXPECT_TRUE(fs::exists(folder_ / (std::string(name) + staged_suffix)));
    EXPECT_EQ(DeckFrames(folder_).heads().back().step, earlier_steps);

    DeckRun(going_on(new_steps - earlier_steps)).run();
    const Contents after = contents(folder_);
    EXPECT_TRUE(after == new_) << "the continued earlier run, and nothing of the stopped run";
}

TEST_F(ReplacedDeck, IsReplacedByTheNextRunWhateverAStoppedOneLeft) {
    EXPECT_THROW(DeckRun(forced()).run([](const World&) -> bool { throw Killed(); }), Killed);
    DeckRun(forced()).run();
    EXPECT_TRUE(contents(folder_) == new_);
}

TEST_F(ReplacedDeck, GivesWayWithTheFirstSave) {
    DeckOptions options = forced();
    options.save_interval = 0.0;  // saves whenever the clock is read, every 64 steps
    const auto die = [&](const World& world) {
        if (world.stepping.steps == 0) {
            EXPECT_TRUE(named() == earlier_);
        }
        if (world.stepping.steps == 1) {
            EXPECT_EQ(DeckFrames(folder_).heads().back().step, 0) << "files of the new run";
        }
        if (world.stepping.steps == 200) throw Killed();
        return true;
    };
    EXPECT_THROW(DeckRun(options).run(die), Killed);
    EXPECT_TRUE(named() == contents(folder_));
    DeckRun rest(going_on(new_steps - 192));
    EXPECT_EQ(rest.first_step(), 192);
    rest.run();
    EXPECT_TRUE(contents(folder_) == new_);
}

TEST_F(ReplacedDeck, StoppedWhileItGivesWayIsTheNewOneForWhoeverReadsIt) {
    FileSet files;
    for (const char* name : next_files) files.emplace_back(name, new_.at(name));
    Renames renames;
    for (const char* name : deck_output_names) renames.emplace_back(std::string(name) + staged_suffix, name);
    for (std::size_t renamed = 0; renamed <= renames.size(); ++renamed) {
        fs::remove_all(folder_);
        fs::create_directory(folder_);
        for (const auto& [name, text] : earlier_) std::ofstream(folder_ / name, std::ios::binary) << text;
        for (const auto& [from, to] : renames) std::ofstream(folder_ / from, std::ios::binary) << new_.at(to);
        write_journal(deck_journal(folder_), files, renames);
        for (std::size_t k = 0; k < renamed; ++k) fs::rename(folder_ / renames[k].first, folder_ / renames[k].second);
        EXPECT_EQ(DeckFrames(folder_).heads().back().step, new_steps) << renamed;
        EXPECT_TRUE(contents(folder_) == new_) << renamed;
    }
}

TEST_F(ReplacedDeck, IsReadWhileItsRunReplacesTheFilesToGoOnWith) {
    FileSet files;
    for (const char* name : next_files) files.emplace_back(name, new_.at(name));
    const FolderLock running(folder_);
    write_journal(deck_journal(folder_), files);
    EXPECT_EQ(DeckFrames(folder_).heads().back().step, earlier_steps);
    EXPECT_TRUE(fs::exists(deck_journal(folder_))) << "only a run completes it";
}

TEST_F(ReplacedDeck, KeepsItsFilesWhereTheNewRunIsUnstable) {
    const fs::path deck = scratch_ / "unstable";
    fs::create_directory(deck);
    for (const auto& file : fs::directory_iterator(shipped_deck("embankment")))
        if (file.path().extension() == ".dat") fs::copy_file(file.path(), deck / file.path().filename());
    DeckOptions options = forced();
    options.folder = deck;
    const auto spoil = [](const World& world) {
        if (world.stepping.steps == 50) throw UnstableRun(50, 1, "as a test has it");
        return true;
    };
    try {
        DeckRun(options).run(spoil);
        ADD_FAILURE() << "ran to the end";
    } catch (const UnstableRun& error) {
        EXPECT_EQ(std::string(error.what()),
                  "unstable at step 50, body 1: as a test has it; earlier outputs in " + folder_.string() +
                      " are unchanged, and the outputs of this run so far are in " + folder_.string() + "/*.dat.new");
    }
    EXPECT_TRUE(named() == earlier_);
}

/// A full disc is simulated by a file size limit that the largest output exceeds.
TEST_F(ReplacedDeck, KeepsItsFilesAndSaysSoWhereTheNewOutputsCannotBeWritten) {
    std::size_t largest = 0;
    for (const auto& [name, text] : new_)
        if (!name.starts_with("new_")) largest = std::max(largest, text.size());
    const auto ignored = signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit half{largest / 2, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &half), 0);
    std::string message;
    try {
        DeckRun(forced()).run();
    } catch (const SystemFailure& error) {
        message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, ignored);
    EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with("; earlier outputs in " + folder_.string() + " are unchanged")) << message;
    EXPECT_TRUE(contents(folder_) == earlier_) << "nothing of the new run is left";
}

TEST_F(ReplacedDeck, WithAStateOfAnotherVersionSaysHowToGoOnWithoutIt) {
    std::string state = read_file(folder_ / "new_state.bin");
    // The magic number of a checkpoint is followed by its version.
    const std::string whole = save_world(DeckRun(options(scratch_ / "other", 1)).world());
    const std::size_t at = state.find(whole.substr(0, 8));
    ASSERT_NE(at, std::string::npos);
    state[at + 8] = 99;
    std::ofstream(folder_ / "new_state.bin", std::ios::binary) << state;
    try {
        DeckRun(going_on(10)).run();
        ADD_FAILURE() << "read";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("new_state.bin: found checkpoint version 99, expected "), std::string::npos) << message;
        EXPECT_TRUE(message.ends_with("; remove it to continue from the text files")) << message;
    }
    fs::remove(folder_ / "new_state.bin");
    EXPECT_NO_THROW(DeckRun(going_on(10)).run());
}

TEST_F(ReplacedDeck, ApartFromItsFirstPartIsReplacedAlike) {
    const fs::path first = scratch_ / "first";
    DeckRun(options(first, 100)).run();
    DeckOptions second;
    second.folder = first;
    second.goes_on = true;
    second.output = folder_;
    second.steps = 100;
    second.overwrite = true;
    EXPECT_THROW(DeckRun(second).run([](const World&) -> bool { throw Killed(); }), Killed);
    EXPECT_TRUE(named() == earlier_);
    DeckRun(second).run();
    const Contents apart = contents(folder_);
    second.output = scratch_ / "beside";
    DeckRun(second).run();
    EXPECT_TRUE(apart == contents(second.output));
}

TEST_F(ReplacedDeck, OpenedByAReaderStaysTheSameUntilItHasRead) {
    const DeckFrames frames(folder_);
    DeckRun(forced()).run();
    const DeckFrames later(folder_);
    EXPECT_EQ(frames.heads().back().step, earlier_steps);
    EXPECT_EQ(later.heads().back().step, new_steps);
    const auto last = frames.positions(frames.heads().size() - 1).circles;
    const auto newer = later.positions(later.heads().size() - 1).circles;
    ASSERT_FALSE(last.empty());
    EXPECT_NE(last.front().centre.y, newer.front().centre.y);
}

}  // namespace
}  // namespace crackle
