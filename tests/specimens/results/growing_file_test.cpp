// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a growing file continues only from the state marked by a checkpoint.

#include "specimens/results/growing_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

class AGrowingFile : public ::testing::Test {
  protected:
    /// Writes two lines, marks them, and writes a third.
    FileMark written() const {
        GrowingFile file(path_, {});
        file.write("one\n");
        file.write("two\n");
        file.flush();
        const FileMark mark = file.mark();
        file.write("three\n");
        file.flush();
        return mark;
    }
    static void expect_refused(const std::string& says, const std::function<void()>& act) {
        try {
            act();
            ADD_FAILURE() << "accepted, expected: " << says;
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
        }
    }
    testing::ScratchFolder scratch_;
    fs::path path_ = scratch_ / "curve.csv";
};

TEST_F(AGrowingFile, GoesOnBehindItsMark) {
    const FileMark mark = written();
    EXPECT_EQ(mark.bytes, 8U);
    GrowingFile file(path_, mark);
    file.write("other\n");
    file.flush();
    EXPECT_EQ(read_file(path_), "one\ntwo\nother\n");
    FileMark all = file.mark();
    GrowingFile again(path_, all);  // the hash was continued as well
    EXPECT_EQ(again.mark().hash, all.hash);
    EXPECT_NE(all.hash, mark.hash);
}

TEST_F(AGrowingFile, BeginsAgainWithoutAMark) {
    written();
    GrowingFile file(path_, {});
    file.flush();
    EXPECT_EQ(read_file(path_), "");
}

TEST_F(AGrowingFile, ThatWasEditedOrCutIsRefusedAndStaysAsItIs) {
    const FileMark mark = written();
    for (const std::string text : {"one\ntwO\nthree\n", "one\n", ""}) {
        std::ofstream(path_) << text;
        expect_refused("expected the first 8 bytes as they were written", [&] { GrowingFile(path_, mark); });
        EXPECT_EQ(read_file(path_), text);
    }
    fs::remove(path_);
    expect_refused("expected the first 8 bytes", [&] { GrowingFile(path_, mark); });
    EXPECT_FALSE(fs::exists(path_));
}

TEST_F(AGrowingFile, ThatIsTakenAwayIsNoticedWhenItIsFlushed) {
    GrowingFile moved(path_, {});
    moved.write("one\n");
    moved.flush();
    fs::rename(path_, scratch_ / "elsewhere.csv");
    expect_refused("it was moved or changed while the test ran", [&] { moved.flush(); });
    GrowingFile replaced(path_, {});
    replaced.write("one\n");
    replaced.flush();
    std::ofstream(path_) << "";
    expect_refused("found 0 bytes, expected the 4 bytes", [&] { replaced.flush(); });
}

}  // namespace
}  // namespace crackle
