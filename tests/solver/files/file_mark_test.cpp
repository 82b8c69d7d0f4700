// SPDX-License-Identifier: GPL-3.0-or-later
// Tests length and hash of a file.
#include "solver/files/file_mark.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "solver/base/errors.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

TEST(FileMark, IsTheHashOfXxhsum) {
    // Expected values are from `printf crackle | xxhsum -H3`, and from empty input.
    EXPECT_EQ(hash_text(mark_of("")), "2d06800538d394c2");
    EXPECT_EQ(mark_of("crackle").bytes, 7U);
    EXPECT_NE(mark_of("crackle"), mark_of("crackLe"));
}

TEST(FileMark, OfAFileIsThatOfItsBytes) {
    const testing::ScratchFolder scratch;
    for (const std::size_t length : {0U, 1U, 65536U, 65537U, 1'000'003U}) {
        std::string text(length, '\0');
        for (std::size_t k = 0; k < length; ++k) text[k] = static_cast<char>(k * k >> 3);
        std::ofstream(scratch / "file", std::ios::binary) << text;
        EXPECT_EQ(mark_of_file(scratch / "file"), mark_of(text)) << length;
    }
}

TEST(FileMark, OfAFileThatCannotBeReadIsNone) {
    const testing::ScratchFolder scratch;
    EXPECT_THROW(mark_of_file(scratch / "absent"), InputError);
    EXPECT_THROW(mark_of_file(scratch / ""), InputError) << "a folder";
}

}  // namespace
}  // namespace crackle
