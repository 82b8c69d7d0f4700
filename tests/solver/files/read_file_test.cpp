// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that reading a file gives all its bytes or an error, never only its first part.
#include "solver/files/read_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

std::string refusal_of(const std::filesystem::path& path) {
    try {
        static_cast<void>(read_file(path));
    } catch (const InputError& error) {
        return error.what();
    } catch (const SystemFailure& failure) {
        return failure.what();
    }
    return "";
}

TEST(ReadFile, GivesEveryByteWhateverTheLength) {
    const testing::ScratchFolder scratch;
    for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{200'001}}) {
        std::string bytes(length, '\0');
        for (std::size_t k = 0; k < length; ++k) bytes[k] = static_cast<char>(k * k);
        std::ofstream(scratch / "file", std::ios::binary) << bytes;
        EXPECT_TRUE(read_file(scratch / "file") == bytes) << length;
    }
}

TEST(ReadFile, RefusesWhatIsNoneOrStopsBeforeItsEnd) {
    const testing::ScratchFolder scratch;
    EXPECT_NE(refusal_of(scratch / "absent").find("No such file"), std::string::npos);
    EXPECT_NE(refusal_of(scratch / "").find("found a folder"), std::string::npos);
    // This file can be opened, but reading it fails with EIO, as on a failing disc.
    EXPECT_NE(refusal_of("/proc/self/mem").find("reading stopped with an error (Input/output error)"),
              std::string::npos)
        << refusal_of("/proc/self/mem");
}

TEST(ReadFile, RefusesMoreBytesThanItsKindMayHave) {
    const testing::ScratchFolder scratch;
    std::ofstream(scratch / "file") << "12345";
    EXPECT_EQ(read_file(scratch / "file", 5), "12345");
    for (const std::filesystem::path& path : {scratch / "file", std::filesystem::path("/dev/zero")})
        EXPECT_NE(testing::refusal([&] { read_text(path, 4); }).find("found more than 4 bytes, expected at most 4"),
                  std::string::npos);
    std::filesystem::resize_file(scratch / "file", most_bytes_of_table + 1);  // a sparse file, of which nothing is read
    EXPECT_NE(testing::refusal([&] { read_text(scratch / "file", most_bytes_of_table); }).find("1073741824 bytes"),
              std::string::npos);
}

TEST(ReadText, LeavesOutTheByteOrderMarkOnce) {
    const testing::ScratchFolder scratch;
    for (const char* text : {"", "size", "\xef\xbb", "\xef\xbb\xbf"}) {
        std::ofstream(scratch / "marked", std::ios::binary) << "\xef\xbb\xbf" << text;
        EXPECT_EQ(read_text(scratch / "marked"), text);
    }
    std::ofstream(scratch / "plain", std::ios::binary) << "\xef\xbb?";
    EXPECT_EQ(read_text(scratch / "plain"), "\xef\xbb?");
}

TEST(ReadText, NamesLettersOfTwoBytes) {
    using namespace std::string_literals;
    for (const std::string& text : {"\xff\xfe"
                                    "3\0"s,
                                    "\xfe\xff\0003"s, "3\0 \0"s, "\0003\0 "s})
        EXPECT_NE(testing::refusal([&] { refuse_wide_letters("in_bc.dat", text); }).find("in_bc.dat: found UTF-16"),
                  std::string::npos);
    EXPECT_NO_THROW(refuse_wide_letters("in_bc.dat", "3 1"));
    EXPECT_NO_THROW(refuse_wide_letters("in_bc.dat", ""));
}

}  // namespace
}  // namespace crackle
