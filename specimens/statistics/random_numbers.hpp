// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions on std::mt19937_64, whose sequence the standard fixes; what std::uniform_real_distribution and its kin
// make of it is up to each library, and a seed must give the same specimen everywhere.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace crackle {

/// Uniform in [0, 1), 53 bits.
inline double uniform_number(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

/// Uniform in [low, high).
inline double uniform_number(std::mt19937_64& generator, double low, double high) {
    return low + (high - low) * uniform_number(generator);
}

/// Uniform in {0, …, bound - 1}, without bias; bound > 0.
inline std::uint64_t uniform_below(std::mt19937_64& generator, std::uint64_t bound) {
    const std::uint64_t excess = (0 - bound) % bound;  // 2^64 mod bound: values below it would favour small results
    std::uint64_t value = generator();
    while (value < excess) value = generator();
    return value % bound;
}

/// Fisher-Yates.
template <typename T>
void shuffle(std::vector<T>& items, std::mt19937_64& generator) {
    for (std::size_t left = items.size(); left > 1; --left)
        std::swap(items[left - 1], items[uniform_below(generator, left)]);
}

}  // namespace crackle
