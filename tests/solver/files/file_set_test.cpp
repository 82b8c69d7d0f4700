// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that either all files of a set are replaced or none, wherever the process is stopped.
#include "solver/files/file_set.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "solver/base/errors.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
  protected:
    const FileSet old_{{"a.dat", "old a"}, {"b.dat", "old b"}, {"c.bin", std::string("old\0c", 5)}};
    const FileSet new_{{"a.dat", "new a\n"}, {"b.dat", ""}, {"c.bin", std::string(100'000, 'c')}};

    testing::ScratchFolder scratch_;
    fs::path folder_ = scratch_ / "set";

    Files() { fs::create_directory(folder_); }

    fs::path journal() const { return folder_ / "set.journal"; }

    void write(const std::string& name, const std::string& contents) const {
        std::ofstream(folder_ / name, std::ios::binary) << contents;
    }
    std::string read(const std::string& name) const {
        std::ifstream in(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    void expect_whole(const FileSet& files) const {
        for (const auto& [name, contents] : files) EXPECT_TRUE(read(name) == contents) << name;
        std::size_t there = 0;
        for ([[maybe_unused]] const fs::directory_entry& entry : fs::directory_iterator(folder_)) ++there;
        EXPECT_EQ(there, files.size()) << "something was left behind";
    }
};

TEST_F(Files, AreAllReplacedAndNothingIsLeftBehind) {
    write_journal(journal(), old_);
    EXPECT_TRUE(complete_replacement(journal()));
    expect_whole(old_);
    write_journal(journal(), new_);
    EXPECT_TRUE(complete_replacement(journal()));
    expect_whole(new_);
    EXPECT_FALSE(complete_replacement(journal()));
}

TEST_F(Files, StoppedAfterAnyOfThemAreCompletedByTheNextReader) {
    for (std::size_t replaced = 0; replaced <= new_.size(); ++replaced) {
        for (const auto& [name, contents] : old_) write(name, contents);
        write_journal(journal(), new_);
        for (const auto& [name, contents] : old_)
            EXPECT_EQ(read(name), contents) << "before the replacement is completed";
        for (std::size_t k = 0; k < replaced; ++k)
            fs::rename(folder_ / (new_[k].first + staged_suffix), folder_ / new_[k].first);
        EXPECT_TRUE(complete_replacement(journal())) << replaced;
        expect_whole(new_);
    }
}

TEST_F(Files, OfWhichOneCannotBeWrittenStayAsTheyAre) {
    for (const auto& [name, contents] : old_) write(name, contents);
    fs::create_directories(folder_ / "c.bin.new" / "not empty");
    EXPECT_THROW(write_journal(journal(), new_), OutputError);
    fs::remove_all(folder_ / "c.bin.new");
    expect_whole(old_);
    fs::create_symlink("absent", journal());
    EXPECT_THROW(write_journal(journal(), new_), OutputError);
    fs::remove(journal());
    expect_whole(old_);
}

TEST_F(Files, AreGivenTheNamesThatTheJournalSays) {
    const char* const names[] = {"b.dat"};
    EXPECT_FALSE(gives_name(journal(), names)) << "no journal";
    write_journal(journal(), new_);
    EXPECT_TRUE(gives_name(journal(), names));
    const char* const others[] = {"b.dat.new", "d.dat"};
    EXPECT_FALSE(gives_name(journal(), others));
}

TEST_F(Files, WrittenUnderOtherNamesGetTheirsWithTheSet) {
    const Renames renames{{"large.dat.new", "large.dat"}, {"other.dat.new", "other.dat"}};
    FileSet all = new_;
    all.emplace_back("large.dat", "new rows");
    all.emplace_back("other.dat", "new, too");
    for (std::size_t renamed = 0; renamed <= renames.size(); ++renamed) {
        for (const auto& [name, contents] : old_) write(name, contents);
        for (const auto& [name, contents] : all) {
            if (name != "large.dat" && name != "other.dat") continue;
            write(name, "old");
            write(name + ".new", contents);
        }
        write_journal(journal(), new_, renames);
        for (std::size_t k = 0; k < renamed; ++k) fs::rename(folder_ / renames[k].first, folder_ / renames[k].second);
        EXPECT_TRUE(complete_replacement(journal())) << renamed;
        expect_whole(all);
    }
}

TEST_F(Files, OfADamagedJournalStayAsTheyAre) {
    for (const auto& [name, contents] : old_) write(name, contents);
    write_journal(journal(), new_);
    const std::string whole = read("set.journal");
    for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{20}, whole.size() - 1}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        write("set.journal", damaged);
        EXPECT_THROW(complete_replacement(journal()), InputError) << at;
        write("set.journal", whole.substr(0, at));
        EXPECT_THROW(complete_replacement(journal()), InputError) << at;
    }
    write("set.journal", "CRKLSET2" + whole.substr(8));
    EXPECT_THROW(complete_replacement(journal()), InputError) << "of another version";
    fs::remove(journal());
    for (const auto& [name, contents] : new_) fs::remove(folder_ / (name + staged_suffix));
    expect_whole(old_);
}

TEST_F(Files, OfAJournalThatNamesOtherFoldersAreRefused) {
    write("inside.dat", "x");
    for (const Renames& renames : {Renames{{"inside.dat", "../outside.dat"}}, {{"../set/inside.dat", "a.dat"}}}) {
        write_journal(journal(), {}, renames);
        EXPECT_THROW(complete_replacement(journal()), InputError);
    }
    EXPECT_FALSE(fs::exists(folder_.parent_path() / "outside.dat"));
}

}  // namespace
}  // namespace crackle
