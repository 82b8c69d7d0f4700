// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that arrays on disc return the values stored in them, in any order, and leave no files behind.
#include "solver/files/scratch_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "solver/base/errors.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

TEST(ScratchArray, HoldsWhatWasPutIntoItWhereverThatIs) {
    const testing::ScratchFolder scratch;
    ScratchArray<std::uint64_t> numbers(scratch / "");
    const std::size_t count = 200'003;  // more than fits in memory at once
    numbers.assign(count, 7);
    std::vector<std::uint64_t> wanted(count, 7);
    for (std::size_t k = 0; k < count; k += 3) numbers[k] = wanted[k] = k * k;
    for (const std::size_t k : {std::size_t{5}, count - 1, std::size_t{100'000}, std::size_t{4}})
        numbers[k] = wanted[k] = 1'000'000 + k;
    EXPECT_EQ(numbers.values(), wanted);
    EXPECT_EQ(numbers[100'000], wanted[100'000]);

    numbers.resize(10);
    for (std::size_t k = 0; k < 10; ++k) numbers[k] = k;
    EXPECT_EQ(numbers.values(), (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_TRUE(std::filesystem::is_empty(scratch / "")) << "a file with a name";
}

TEST(ScratchArray, IsMadeOneAfterTheOther) {
    const testing::ScratchFolder scratch;
    ScratchArray<std::uint64_t> numbers(scratch / "");
    std::vector<std::uint64_t> wanted;
    numbers.generate(70'001, [&](std::size_t k) { return wanted.emplace_back(3 * k + 1); });
    EXPECT_EQ(wanted.size(), 70'001U);
    EXPECT_EQ(numbers.values(), wanted);
    EXPECT_EQ(numbers[40'000], wanted[40'000]);
}

TEST(ScratchArray, OfNothingIsEmptyAndWhatWasNeverPutIsZero) {
    const testing::ScratchFolder scratch;
    ScratchArray<double> numbers(scratch / "");
    EXPECT_TRUE(numbers.values().empty());
    numbers.resize(100'000);
    numbers[99'999] = 2.0;
    EXPECT_EQ(numbers[1], 0.0);
    EXPECT_EQ(numbers.values().back(), 2.0);
}

TEST(ScratchArray, RefusesAFolderThatTakesNoFile) {
    const testing::ScratchFolder scratch;
    std::ofstream(scratch / "file") << "no folder";
    try {
        const ScratchFile file(scratch / "file");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("cannot be written (Not a directory)"), std::string::npos);
    }
}

}  // namespace
}  // namespace crackle
