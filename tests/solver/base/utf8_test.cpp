// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace crackle {
namespace {

TEST(Utf8, TheFirstLetterHasItsLengthAndCodePoint) {
    const auto expect = [](const std::string& text, std::size_t bytes, std::uint32_t code) {
        const Letter letter = first_letter(text);
        EXPECT_EQ(letter.bytes, bytes) << text;
        EXPECT_EQ(letter.code, code) << text;
    };
    expect("ab", 1, 'a');
    expect("\xc2\x80", 2, 0x80);
    expect("\xcf\x83z", 2, 0x3c3);  // σ
    expect("\xe3\x80\x80", 3, 0x3000);
    expect("\xf0\x9f\x9a\x80", 4, 0x1f680);
    expect("\xf4\x8f\xbf\xbf", 4, 0x10ffff);
}

TEST(Utf8, WhatIsNotValidHasNoBytesAndItsFirstByte) {
    for (const std::string text : {"\x80", "\xc1\xbf", "\xc3", "\xc3z", "\xe0\x80\xaf", "\xed\xa0\x80", "\xe3\x80",
                                   "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"}) {
        const Letter letter = first_letter(text);
        EXPECT_EQ(letter.bytes, 0U) << ::testing::PrintToString(text);
        EXPECT_EQ(letter.code, static_cast<unsigned char>(text[0]));
    }
}

TEST(Utf8, CountsLettersAndNotBytes) {
    EXPECT_EQ(count_letters(""), 0U);
    EXPECT_EQ(count_letters("σ₃, MPa"), 7U);
    EXPECT_EQ(count_letters("岩石"), 2U);
}

}  // namespace
}  // namespace crackle
