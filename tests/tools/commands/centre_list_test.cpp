// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of centres without the program about them, so that the short job of the sanitizers reads some, too.
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
    EXPECT_FALSE(looks_like_centre_list("1 2 3\n4 5\n"));
    EXPECT_FALSE(looks_like_centre_list("# nothing else"));
    EXPECT_FALSE(looks_like_centre_list(""));
}

TEST(CentreList, RefusalsNameTheLineAndWhatStandsThere) {
    EXPECT_EQ(refusal_of("1 2\n3\n"), "centres.txt:2: found 1 word, expected two numbers x y");
    EXPECT_EQ(refusal_of("1 2\n3 nan\n"), "centres.txt:2: y: found 'nan', expected a finite number");
    EXPECT_EQ(refusal_of("1e999 2\n"), "centres.txt:1: x: found '1e999', expected a finite number");
    EXPECT_EQ(refusal_of("\n# 1 2\n"), "centres.txt: found no centres, expected lines of x y");
}

}  // namespace
}  // namespace crackle::tools
