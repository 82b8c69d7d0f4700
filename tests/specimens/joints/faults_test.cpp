// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that rows of a file are joined if, and only if, they are segments of the same fault, in any order and
// direction.

#include "specimens/joints/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace crackle::faults_test {
namespace {

using Rows = std::vector<std::vector<Vec2>>;

TEST(Faults, SegmentsAreOneWhateverTheirOrderAndDirection) {
    const std::vector<Vec2> whole{{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.1}, {3.0, 0.5}, {4.0, 0.4}, {4.5, 1.5}};
    std::mt19937_64 generator(1);
    for (int n = 0; n < 50; ++n) {
        Rows rows;
        for (std::size_t k = 0; k + 1 < whole.size(); ++k) rows.push_back({whole[k], whole[k + 1]});
        for (std::size_t k = rows.size() - 1; k > 0; --k) std::swap(rows[k], rows[generator() % (k + 1)]);
        for (auto& row : rows)
            if (generator() % 2 == 0) std::reverse(row.begin(), row.end());
        const auto faults = joined_rows(rows, 0.0);
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_EQ(faults[0].row, 0U);
        EXPECT_EQ(faults[0].rows, 5U);
        std::vector<Vec2> found = faults[0].points;
        const auto at = std::find(found.begin(), found.end(), rows[0][0]);
        ASSERT_NE(at, found.end());
        EXPECT_TRUE(at + 1 != found.end() && *(at + 1) == rows[0][1]) << "the first row gives the direction";
        if (found.front() != whole.front()) std::reverse(found.begin(), found.end());
        EXPECT_EQ(found, whole);
    }
}

TEST(Faults, WhereThreeMeetTheStraightestGoOn) {
    const Rows rows{{{0.0, 0.0}, {1.0, 0.0}}, {{1.5, 0.8}, {1.0, 0.0}}, {{1.0, 0.0}, {2.0, 0.1}}};
    const auto faults = joined_rows(rows, 0.0);
    ASSERT_EQ(faults.size(), 2U);
    EXPECT_EQ(faults[0].points, (std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.1}}));
    EXPECT_EQ(faults[1].points, rows[1]);
    const Rows star{{{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {-0.5, 0.87}}, {{0.0, 0.0}, {-0.5, -0.86}}};
    EXPECT_EQ(joined_rows(star, 0.0).size(), 2U) << "60 degrees and a little less, 60 and a little more";
    const Rows wide{{{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {0.0, 1.0}}, {{0.0, 0.0}, {-0.2, 1.0}}};
    EXPECT_EQ(joined_rows(wide, 0.0).size(), 3U) << "bends of 79 degrees and more";
}

TEST(Faults, ARowThatRunsBackOrComesTwiceIsNoPartOfTheOther) {
    EXPECT_EQ(joined_rows({{{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {1.0, 0.0}}}, 0.0).size(), 2U);
    EXPECT_EQ(joined_rows({{{0.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {0.0, 0.1}}}, 0.0).size(), 2U);
    EXPECT_EQ(joined_rows({{{0.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {1.1, 1.0}}}, 0.0).size(), 1U) << "a bend";
    EXPECT_EQ(joined_rows({{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}}}, 0.0).size(), 1U) << "a loop";
    const auto ring = joined_rows({{{0.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {1.0, 1.0}}, {{1.0, 1.0}, {0.0, 0.0}}}, 0.0);
    ASSERT_EQ(ring.size(), 1U);
    EXPECT_EQ(ring[0].points.size(), 4U);
}

TEST(Faults, EndsWithinTheReachAreAtOneNodeAndKeepTheirPlaces) {
    const Rows rows{{{0.0, 0.0}, {1.0, 0.0}}, {{1.004, 0.003}, {2.0, 0.0}}};
    EXPECT_EQ(joined_rows(rows, 0.0).size(), 2U);
    EXPECT_EQ(joined_rows(rows, 0.0049).size(), 2U);
    const auto faults = joined_rows(rows, 0.0051);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].points, (std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, {1.004, 0.003}, {2.0, 0.0}}));
}

}  // namespace
}  // namespace crackle::faults_test
