// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of [minerals], [[mineral]] and [[mineral_pair]] against each other.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include "specimens/case/test_case.hpp"

namespace crackle {

/// Shares written in decimals may miss 1 by so much.
inline constexpr double share_rounding = 1e-6;

/// @throws InputError «file:line: key: found X, expected Y; what to do»
void check_minerals(const TestCase& test);

}  // namespace crackle
