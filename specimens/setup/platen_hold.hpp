// SPDX-License-Identifier: GPL-3.0-or-later
// Whether bonds hold a specimen between its platens, before anything is measured on it.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "specimens/case/case_file.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Share of the specimen's width over which the particles bonded with a platen must at least reach.
inline constexpr double min_platen_hold = 0.5;

/// @param setup of a world with bonded platens
/// @throws InputError if a platen holds nothing or only a corner of the specimen, or if no chain of bonds leads from
/// one platen to the other: strength and stiffness would be those of the few bonds there are.
void check_platen_hold(const World& world, const TestSetup& setup, const Platens& platens, const TestCase& test);

}  // namespace crackle
