// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <numeric>

namespace crackle {
namespace {

std::uintptr_t place_of(const Array<double>& numbers) { return reinterpret_cast<std::uintptr_t>(numbers.data()); }

TEST(LargePages, LargeArraysBeginAPageAndSmallOnesDoNotNeedTo) {
    constexpr std::size_t page = LargePages<double>::page;
    const std::size_t large = LargePages<double>::fewest_pages * page / sizeof(double);
    for (const std::size_t count : {large, large + 1, 3 * large}) {
        const Array<double> numbers(count);
        EXPECT_EQ(place_of(numbers) % page, 0U) << count << " numbers";
    }
    int others = 0;
    for (int n = 0; n < 4; ++n) {
        const Array<double> numbers(large - 1);
        others += place_of(numbers) % page != 0 ? 1 : 0;
    }
    EXPECT_GT(others, 0) << "small arrays are aligned to pages too: too little memory";
}

TEST(LargePages, NumbersStayWhenAnArrayGrowsFromSmallToLarge) {
    Array<std::uint32_t> numbers;
    const std::size_t count = 3 * LargePages<std::uint32_t>::page / sizeof(std::uint32_t);
    for (std::uint32_t n = 0; n < count; ++n) numbers.push_back(n);
    Array<std::uint32_t> expected(count);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_TRUE(numbers == expected);
    numbers.resize(5);
    numbers.shrink_to_fit();
    EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0U), 10U);
}

TEST(LargePages, MoreThanCanBeAddressedIsRefused) {
    LargePages<double> room;
    EXPECT_THROW(static_cast<void>(room.allocate(static_cast<std::size_t>(-1) / 4)), std::bad_array_new_length);
}

}  // namespace
}  // namespace crackle
