// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that decks are read as by Fortran's list-directed READ: values, notes, ignored and refused text.
#include "solver/demseg/deck_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "solver/demseg/boundary.hpp"
#include "solver/demseg/geometry.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using testing::refusal;
using Values = std::vector<double>;

/// Executes one READ after another, with the given numbers of values.
std::vector<Values> reads(DeckReader& reader, const std::vector<int>& counts) {
    std::vector<Values> all;
    for (const int count : counts) {
        reader.begin_read();
        all.emplace_back();
        for (int k = 0; k < count; ++k) all.back().push_back(reader.number("value"));
    }
    reader.end_reads();
    return all;
}

std::vector<Values> reads(const std::string& text, const std::vector<int>& counts) {
    DeckReader reader("deck", text);
    return reads(reader, counts);
}

std::string notice(const std::string& text, const std::vector<int>& counts) {
    DeckReader reader("deck", text);
    reads(reader, counts);
    return reader.ignored_numbers().value_or("none");
}

const std::string ignored = "deck: numbers after the last value of a READ are ignored, as DEMseg does: ";
const std::string advice = "; if they are not notes, a line has too many values or a count is too small";

TEST(DeckReader, TakesValuesAsFortranWritesThem) {
    EXPECT_EQ(reads("2.5d0 1.0D+8 .25+8 1.-2 -5e-1 7Q1 +3.\n", {7})[0],
              (Values{2.5, 1e8, 0.25e8, 1e-2, -0.5, 70.0, 3.0}));
    EXPECT_EQ(reads("1,2 , 3\n,4,\n5", {5})[0], (Values{1, 2, 3, 4, 5}));
    EXPECT_EQ(reads("2*1.5d0 3*0.0d0 1*7", {6})[0], (Values{1.5, 1.5, 0.0, 0.0, 0.0, 7.0}));
    EXPECT_EQ(reads("1 2/\n3/ mode\n4 /5 6\n", {2, 1, 1}), (std::vector<Values>{{1, 2}, {3}, {4}}));
    EXPECT_EQ(reads("\xef\xbb\xbf 1\r\n2\x1a 3", {1, 1}), (std::vector<Values>{{1}, {2}}));
}

TEST(DeckReader, AReadTakesAsManyLinesAsItNeedsAndTheNextStartsOnANewOne) {
    EXPECT_EQ(reads("1\n\n2 3 x\n4 y\n5", {3, 1, 1}), (std::vector<Values>{{1, 2, 3}, {4}, {5}}));
    EXPECT_EQ(reads("1 2 3\n4 5 6\n", {2, 3}), (std::vector<Values>{{1, 2}, {4, 5, 6}}));
    EXPECT_EQ(reads("6*2\n1", {2, 1}), (std::vector<Values>{{2, 2}, {1}})) << "a repeat count ends with its READ";
}

TEST(DeckReader, NotesAreIgnoredInCp932AndUtf8WithFullWidthBlanks) {
    // 発生させる粒子半径の幅 after a full-width blank. Its CP932 bytes contain ASCII letters: 0x40 to 0x7e.
    const std::string cp932 =
        "\x94\xad\x90\xb6\x82\xb3\x82\xb9\x82\xe9\x97\xb1\x8e\x71\x94\xbc\x8c\x61\x82\xcc\x95\x9d";
    EXPECT_EQ(reads("1.0 2.0\x81\x40" + cp932 + "\n1 " + cp932 + "\n0.5", {2, 1, 1}),
              (std::vector<Values>{{1, 2}, {1}, {0.5}}));
    EXPECT_EQ(reads("1.0\u3000"
                    "2.0\u3000発生させる粒子半径の幅\n1 その材料番号\n0.5 間隙比",
                    {2, 1, 1}),
              (std::vector<Values>{{1, 2}, {1}, {0.5}}));
    EXPECT_EQ(notice("1.0 2.0 発生させる粒子半径の幅\n" + cp932, {2}), "none");
}

TEST(DeckReader, IgnoredNumbersAreANotice) {
    EXPECT_EQ(notice("1 2 3\n4\n", {2, 1}), ignored + "'3' in line 1" + advice);
    EXPECT_EQ(notice("1 a 2d0 b .5+3\n2 3*0.\n4\n5 6\n", {1, 1, 1}),
              ignored + "'2d0' in line 1, '.5+3' in line 1, '3*0.' in line 2 and 4 more" + advice);
    EXPECT_EQ(notice("6*0\n1\n", {2, 1}), ignored + "'0' in line 1 and 3 more" + advice);
    EXPECT_EQ(notice("1 / 2 3\n4 No. 5) 6cm n=7 2010-01-02\n", {1, 1}), "none");
}

TEST(DeckReader, RefusesWhatIsNoValueWithTheNumberIgnoredBefore) {
    const auto refused = [](const std::string& text, const std::vector<int>& counts) {
        return refusal([&] { reads(text, counts); });
    };
    const std::string number = ", expected a number";
    const std::string finite = ", expected a finite number such as 2.5, 1e8 or 1.0d8";
    EXPECT_EQ(refused("1,,2", {3}), "deck:1: value: found ',' without a value before it" + number);
    EXPECT_EQ(refused("1 /\n2", {2}), "deck:1: value: found '/', which ends the values of a READ" + number);
    EXPECT_EQ(refused("1 2*", {2}), "deck:1: value: found '2*'" + number);
    EXPECT_EQ(refused("0*5", {1}), "deck:1: value: found '0*5'" + number);
    EXPECT_EQ(refused("x*5", {1}), "deck:1: value: found 'x*5'" + number);
    EXPECT_EQ(refused("+-5", {1}), "deck:1: value: found '+-5'" + finite);
    EXPECT_EQ(refused("1d999", {1}), "deck:1: value: found '1d999'" + finite);
    EXPECT_EQ(refused("1 \x95\x9d", {2}), "deck:1: value: found '\\x95\\x9d'" + finite);
    EXPECT_EQ(refused("1 間隙比", {2}), "deck:1: value: found '間隙比'" + finite);
    const std::string before =
        "; before that, '3' in line 1 was ignored, because each READ of DEMseg starts on a new line";
    EXPECT_EQ(refused("1 2 3\nx", {2, 1}), "deck:2: value: found 'x'" + finite + before);
    EXPECT_EQ(
        refused("1 2 3\n", {2, 1}),
        "deck:2: value: found the end of the file, expected a number; the file is cut off or a count in it is too "
        "large" +
            before);
    EXPECT_EQ(
        refused("1 \x1a 2", {2}),
        "deck:1: value: found the end of the file, expected a number; the file is cut off or a count in it is too "
        "large");
}

TEST(DeckReader, SegmentsAndIdsOfNpfdMayStandOnOneLineOrOnSeveral) {
    const std::string head = "1 0 0\n2d-5 0 -980\n1\n2.5 1d8 .25d8 0 0 0\n-10 10 0 10 0\n0 1 0\n1 1 2\n0 0 0\n";
    for (const char* ends :
         {"1 -2 2\n2 4\n2 2 4\n1 7\n", "1 -2 2 2 4\n2 2,4,1,7\n", "1 -2 2 3 本\n2 4\n2 2 4 始点\n1 7"}) {
        DeckReader reader("in_gm.dat", head + ends);
        EXPECT_EQ(read_deck_geometry(reader).scene.vertices, (std::vector<Vec2>{{-2, 2}, {2, 4}, {1, 7}})) << ends;
    }
    for (const char* ids : {"1 20\n", "1\n20\n", "1 左端\n20 右端 2\n", "1,\n20"}) {
        DeckReader reader("in_bc.dat", std::string("0 0 10 1 1\n2\n") + ids + "\n0\n");
        EXPECT_EQ(read_boundary(reader).watched, (std::vector<int>{1, 20})) << ids;
    }
}

TEST(DeckReader, WhatFollowsADeckIsIgnoredWithANotice) {
    DeckReader reader("deck", "0 0 10 1 1\n0\n1\n2 1 3 1 0 1 0\n2 1 3 1 0 1 0\n");
    EXPECT_EQ(read_boundary(reader).controls.size(), 1u);
    EXPECT_EQ(reader.ignored_numbers(), ignored + "'2' in line 5, '1' in line 5, '3' in line 5 and 4 more" + advice);
}

}  // namespace
}  // namespace crackle
