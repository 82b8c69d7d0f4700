// SPDX-License-Identifier: GPL-3.0-or-later
// Tests lists of centres without starting the program, so that the short sanitizer job includes some of them.
#include "tools/commands/centre_list.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/refusal.hpp"

namespace crackle::tools {
namespace {

std::string refusal_of(const std::string& text) {
    return testing::refusal([&] { parse_centre_list("centres.txt", text); });
}

TEST(CentreList, BlankLinesAndCommentsArePassedOver) {
    const CentreList list = parse_centre_list("centres.txt", "# x y\n0 0\n\n1.5\t2d-1 # a Fortran exponent\r\n-3 +4e1");
    ASSERT_EQ(list.places.size(), 3U);
    EXPECT_EQ(list.lines, (std::vector<int>{2, 4, 5}));
    EXPECT_EQ(list.places[1].x, 1.5);
    EXPECT_EQ(list.places[1].y, 0.2);
    EXPECT_EQ(list.places[2].x, -3.0);
    EXPECT_EQ(list.places[2].y, 40.0);
}

TEST(CentreList, IsToldFromADeckByItsFirstLine) {
    EXPECT_TRUE(looks_like_centre_list("# one\n\n1 2\n3 4 5\n"));
    EXPECT_TRUE(looks_like_centre_list("1,2\n3,4\n"));
    EXPECT_TRUE(looks_like_centre_list("\"id\";\"x\";\"y\"\n1;2;3\n"));
    EXPECT_TRUE(looks_like_centre_list("0.1 0.2 0.05\n0.2 0.2 0.05\n"));
    EXPECT_FALSE(looks_like_centre_list("1 0 0\n0 0 0\n"));
    EXPECT_FALSE(looks_like_centre_list("1 2 3\n4 5\n"));
    EXPECT_FALSE(looks_like_centre_list("# nothing else"));
    EXPECT_FALSE(looks_like_centre_list(""));
}

TEST(CentreList, ListsOfCirclesHaveCentres) {
    for (const auto& [text, form] : {std::pair{"1,2\n3,4\n", "x y"},
                                     {"x;y\n1;2\n3;4\n", "x y"},
                                     {"id,y,x,radius\n1,2,1,0.5\n2,4,3,0.5\n", "x y r"},
                                     {"1 2 0.5\n3 4 0.25\n", "x y r"},
                                     {"# x y z r\n1 2 7 0.5\n3 4 7 0.25\n", "x y z r"}}) {
        const CentreList list = parse_centre_list("centres.txt", text);
        EXPECT_EQ(list.places, (std::vector<Vec2>{{1.0, 2.0}, {3.0, 4.0}})) << text;
        EXPECT_EQ(list.form, form) << text;
    }
    EXPECT_EQ(refusal_of("1 2 7 0.5\n3 4 8 0.25\n"),
              "centres.txt:2: found z = 8 after z = 7, expected centres in one plane; give the centres of a "
              "plane section");
    EXPECT_EQ(
        refusal_of("0,5 1,5\n"),
        "centres.txt:1: found '0,5', a number with a decimal comma, expected a finite number for x; save the file "
        "with decimal points");
}

TEST(CentreList, RefusalsNameTheLineAndWhatStandsThere) {
    EXPECT_EQ(refusal_of("1 2\n3\n"), "centres.txt:2: found 1 value, expected two numbers x y");
    EXPECT_EQ(refusal_of("1 2\n3 nan\n"), "centres.txt:2: found 'nan', expected a finite number for y");
    EXPECT_EQ(refusal_of("1e999 2\n"), "centres.txt:1: found '1e999', expected a finite number for x");
    EXPECT_EQ(refusal_of("\n# 1 2\n"), "centres.txt: found no centres, expected lines of x y");
}

}  // namespace
}  // namespace crackle::tools
