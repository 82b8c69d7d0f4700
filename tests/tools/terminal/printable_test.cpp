// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a terminal receives only text and no control sequences, whatever names contain.

#include "tools/terminal/printable.hpp"

#include <gtest/gtest.h>

#include "tools/terminal/progress.hpp"

namespace crackle::tools {
namespace {

TEST(Printable, LettersStayAsTheyAre) {
    for (const char* text : {"", "peak 3.1 MPa\n\tat 0.2 %\n", "Körnung 花崗岩 \xf0\x9f\xaa\xa8 \xc2\xa0"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreSpelledOut) {
    EXPECT_EQ(printable("\x1b[31mred\x07\r\x7f"), "\\x1b[31mred\\x07\\x0d\\u007f");
    EXPECT_EQ(printable("\xc2\x80\xc2\x9b"
                        "31m\xc2\x9f"),
              "\\u0080\\u009b31m\\u009f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, WhatIsNoUtf8IsSpelledOut) {
    EXPECT_EQ(printable("\x9b"
                        "31m"),
              "\\x9b31m")
        << "C1 of terminals of eight bits";
    EXPECT_EQ(printable("gr\xfc"
                        "n"),
              "gr\\xfcn");
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut off";
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "an overlong encoding";
    EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b") << "likewise";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "an unpaired UTF-16 surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last character";
}

TEST(Printable, ProgressIsCutOnlyAfterwards) { EXPECT_EQ(progress_text({.detail = "\x1b\x1b\x1b"}, 6), "\\x1b\\x"); }

}  // namespace
}  // namespace crackle::tools
