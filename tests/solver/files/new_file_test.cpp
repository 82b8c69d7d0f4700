// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that new files never overwrite files of others: not through a link, a guessable name or a leftover file.
#include "solver/files/new_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/little_room.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

class NewFiles : public ::testing::Test {
  protected:
    void write(const fs::path& name, const std::string& text) const {
        std::ofstream(scratch_ / name, std::ios::binary) << text;
    }
    std::vector<std::string> temporaries() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(scratch_ / ""))
            if (entry.path().string().ends_with(temporary_suffix)) names.push_back(entry.path().filename().string());
        return names;
    }
    void make_old(const fs::path& file) const {
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
    }

    const testing::ScratchFolder scratch_;
};

TEST_F(NewFiles, GetTheirNamesOnceTheyAreComplete) {
    write("file", "earlier");
    {
        NewFile file(scratch_ / "file");
        file.stream() << std::string(1'000'000, 'x') << "end";
        EXPECT_EQ(read_file(scratch_ / "file"), "earlier");
        EXPECT_EQ(temporaries().size(), 1U);
        file.bring_to_disc();
        file.take_name();
        EXPECT_EQ(read_file(scratch_ / "file"), std::string(1'000'000, 'x') + "end");
    }
    { const NewFile dropped(scratch_ / "file"); }
    EXPECT_EQ(temporaries().size(), 0U);
    EXPECT_EQ(read_file(scratch_ / "file").size(), 1'000'003U);
}

TEST_F(NewFiles, HaveNamesThatAreNeverTheSame) {
    const NewFile first(scratch_ / "file"), second(scratch_ / "file");
    const std::vector<std::string> names = temporaries();
    ASSERT_EQ(names.size(), 2U);
    EXPECT_NE(names[0], names[1]);
    for (const std::string& name : names) EXPECT_EQ(name.size(), 16 + temporary_suffix.size()) << name;
}

TEST_F(NewFiles, DoNotFollowTheLinksOfAStranger) {
    write("stranger", "mine\n");
    fs::create_symlink(scratch_ / "stranger", scratch_ / "page.html.tmp");
    fs::create_symlink(scratch_ / "stranger", scratch_ / "page.html.new");
    replace_file(scratch_ / "page.html", "page");
    EXPECT_EQ(read_file(scratch_ / "page.html"), "page");
    EXPECT_EQ(read_file(scratch_ / "stranger"), "mine\n");

    fs::create_symlink(scratch_ / "stranger", scratch_ / "link");
    fs::create_symlink(scratch_ / "absent", scratch_ / "dangling");
    for (const char* link : {"link", "dangling"}) {
        EXPECT_NE(testing::refusal([&] { replace_file(scratch_ / link, "page"); }).find("found a symbolic link"),
                  std::string::npos);
        EXPECT_NE(testing::refusal([&] {
                      FileStream().open(scratch_ / link, FileStream::Opening::fresh);
                  }).find("found a symbolic link"),
                  std::string::npos);
        EXPECT_TRUE(fs::is_symlink(scratch_ / link));
    }
    EXPECT_EQ(read_file(scratch_ / "stranger"), "mine\n");
    EXPECT_FALSE(fs::exists(scratch_ / "absent"));
}

TEST_F(NewFiles, TakeThePlaceOfNothingButAFile) {
    fs::create_directories(scratch_ / "folder");
    EXPECT_NE(testing::refusal([&] { replace_file(scratch_ / "folder", "page"); }).find("found a folder"),
              std::string::npos);
    ASSERT_EQ(::mkfifo((scratch_ / "pipe").c_str(), 0600), 0);
    EXPECT_NE(testing::refusal([&] { replace_file(scratch_ / "pipe", "page"); }).find("found a device or a pipe"),
              std::string::npos);
    EXPECT_TRUE(temporaries().empty());
}

TEST_F(NewFiles, WithoutRoomAreAFailureOfTheSystemAndLeaveTheEarlierOne) {
    write("file", "earlier");
    std::string message;
    try {
        const testing::LittleRoom room(100);
        replace_file(scratch_ / "file", std::string(1000, 'x'));
    } catch (const SystemFailure& failure) {
        message = failure.what();
    }
    EXPECT_NE(message.find("file: cannot be written (File too large)"), std::string::npos) << message;
    EXPECT_EQ(read_file(scratch_ / "file"), "earlier");
    EXPECT_TRUE(temporaries().empty());
}

TEST_F(NewFiles, OfStoppedProcessesAreRemovedOthersStay) {
    const std::string left = "0123456789abcdef" + std::string(temporary_suffix);
    const std::string foreign[] = {"notes" + std::string(temporary_suffix), "0123456789abcdeX.crackle_tmp",
                                   "0123456789abcdef.crackle_tmp.txt"};
    write(left, "half a page");
    for (const std::string& name : foreign) write(name, "mine\n");
    const std::string link = "00000000deadbeef" + std::string(temporary_suffix);
    fs::create_symlink(scratch_ / foreign[0], scratch_ / link);
    for (const std::string& name : foreign) make_old(scratch_ / name);
    remove_leftovers(scratch_ / "", Leftovers::old);
    EXPECT_TRUE(fs::exists(scratch_ / left)) << "another process may be writing it";
    make_old(scratch_ / left);
    const int held = ::open((scratch_ / left).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    remove_leftovers(scratch_ / "", Leftovers::all);
    EXPECT_TRUE(fs::exists(scratch_ / left)) << "another process is writing it";
    ::close(held);
    remove_leftovers(scratch_ / "", Leftovers::old);
    EXPECT_FALSE(fs::exists(scratch_ / left));
    for (const std::string& name : foreign) EXPECT_EQ(read_file(scratch_ / name), "mine\n");
    EXPECT_TRUE(fs::is_symlink(scratch_ / link));

    const NewFile running(scratch_ / "file");
    for (const std::string& name : temporaries())
        if (name != link && name != foreign[0]) make_old(scratch_ / name);
    remove_leftovers(scratch_ / "", Leftovers::all);
    EXPECT_EQ(temporaries().size(), 4U) << "of a process that runs";
    remove_leftovers(scratch_ / "absent", Leftovers::all);
}

TEST_F(NewFiles, AppendedToGoOnAtTheirEnds) {
    write("rows", "1\n");
    FileStream rows;
    rows.open(scratch_ / "rows", FileStream::Opening::appending);
    for (int k = 2; k < 5000; ++k) rows << k << '\n';
    rows.flush();
    rows.require_written("rows");
    const std::string text = read_file(scratch_ / "rows");
    EXPECT_TRUE(text.starts_with("1\n2\n3\n"));
    EXPECT_TRUE(text.ends_with("\n4998\n4999\n"));
    rows.close();
    rows << "lost";
    EXPECT_THROW(rows.require_written("rows"), OutputError);
}

}  // namespace
}  // namespace crackle
