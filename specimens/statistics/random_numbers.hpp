// SPDX-License-Identifier: GPL-3.0-or-later
// Random distributions based on std::mt19937_64, whose sequence is fixed by the C++ standard. A seed must give the same
// specimen everywhere, but distributions such as std::uniform_real_distribution differ between standard libraries.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace crackle {

/// Random number, uniform in [0, 1), with 53 random bits.
inline double uniform_number(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

/// Random number, uniform in [low, high).
inline double uniform_number(std::mt19937_64& generator, double low, double high) {
    return low + (high - low) * uniform_number(generator);
}

/// Random integer, uniform in {0, …, bound - 1} without bias. @param bound  > 0
inline std::uint64_t uniform_below(std::mt19937_64& generator, std::uint64_t bound) {
    // 2^64 mod bound; values below it are rejected, since they would favour small results.
    const std::uint64_t excess = (0 - bound) % bound;
    std::uint64_t value = generator();
    while (value < excess) value = generator();
    return value % bound;
}

/// Shuffles the items (Fisher-Yates).
template <typename T>
void shuffle(std::vector<T>& items, std::mt19937_64& generator) {
    for (std::size_t left = items.size(); left > 1; --left)
        std::swap(items[left - 1], items[uniform_below(generator, left)]);
}

}  // namespace crackle
