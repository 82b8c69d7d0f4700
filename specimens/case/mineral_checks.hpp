// SPDX-License-Identifier: GPL-3.0-or-later
// Checks [minerals], [[mineral]] and [[mineral_pair]] for consistency.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "specimens/case/test_case.hpp"

namespace crackle {

/// Largest allowed difference between 1 and the sum of area fractions, which are written as rounded decimals.
inline constexpr double share_rounding = 1e-6;

/// Checks the keys of minerals. @throws InputError «file:line: key: found X, expected Y; what to do»
void check_minerals(const TestCase& test);

/// Converts "#rrggbb" to 0xrrggbb; empty for any other text.
std::optional<std::uint32_t> colour_of(const std::string& text);

}  // namespace crackle
