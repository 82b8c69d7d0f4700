// SPDX-License-Identifier: GPL-3.0-or-later
// Checks, before any measurement, that bonds hold a specimen between its platens.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include "specimens/places/places.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Smallest acceptable width of the particles bonded to a platen, as a fraction of the specimen's width.
inline constexpr double min_platen_hold = 0.5;

/// @param setup  the setup of a world with bonded platens
/// @throws InputError if a platen holds nothing or only a corner of the specimen, or if no chain of bonds connects the
/// platens. Strength and stiffness would then depend on a few bonds.
void check_platen_hold(const World& world, const TestSetup& setup, const Platens& platens, const Places& places);

}  // namespace crackle
