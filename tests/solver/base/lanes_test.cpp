// SPDX-License-Identifier: GPL-3.0-or-later
// Tests vector lanes alone, compiled for two, four and eight lanes on any machine.

#include "solver/base/lanes.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace crackle {
namespace {

TEST(LANES_SUITE, TurnRecordsIntoColumnsAndBack) {
    double numbers[lane_count][4], back[lane_count][4];
    const double *first_half[lane_count], *second_half[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        for (int c = 0; c < 4; ++c) numbers[l][c] = 10.0 * l + c;
        first_half[l] = numbers[l];
        second_half[l] = numbers[l] + 2;
    }
    Lanes column[4];
    gather_pairs(first_half, column[0], column[1]);
    gather_pairs(second_half, column[2], column[3]);
    for (int l = 0; l < lane_count; ++l)
        for (int c = 0; c < 4; ++c) EXPECT_EQ(column[c][l], 10.0 * l + c);
    store_quads(back, column[0], column[1], column[2], column[3]);
    EXPECT_EQ(std::memcmp(numbers, back, sizeof back), 0);
}

TEST(LANES_SUITE, SignsAndRoots) {
    const Lanes v = with_sign(all_of<Lanes>(2.25), all_of<Lanes>(-0.0));
    EXPECT_EQ(v[0], -2.25);
    EXPECT_EQ(magnitude(v)[lane_count - 1], 2.25);
    EXPECT_EQ(root(magnitude(v))[lane_count - 1], 1.5);
    Lanes mixed = all_of<Lanes>(1.0);
    mixed[1] = -1.0;
    EXPECT_EQ(mask_of(mixed < 0.0), 2u);
}

TEST(LANES_SUITE, WordsWidenWithoutTheirNeighbours) {
    std::uint32_t words[lane_count + 1];
    for (int l = 0; l <= lane_count; ++l) words[l] = 0xfffffff0u + static_cast<std::uint32_t>(l);
    const LaneBits wide = widened(words);
    for (int l = 0; l < lane_count; ++l)
        EXPECT_EQ(static_cast<std::uint64_t>(wide[l]), 0xfffffff0u + static_cast<unsigned>(l));
}

TEST(LANES_SUITE, OneBitOfTheLastLaneIsSomething) {
    LaneBits v{};
    EXPECT_TRUE(none_of(v));
    for (const int lane : {0, lane_count - 1}) {
        for (const LaneBit bit : {LaneBit{1}, LaneBit{1} << 40, sign_bit}) {
            v = LaneBits{};
            v[lane] = bit;
            EXPECT_FALSE(none_of(v)) << "lane " << lane << ", " << bit;
        }
    }
}

}  // namespace
}  // namespace crackle
