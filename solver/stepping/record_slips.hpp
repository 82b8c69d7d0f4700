// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/record_slips_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Appends Bonds::slips where back-tension bonds have reached their Coulomb limit for the first time, in the order of
/// points. After a force pass, before bodies move; linear in listed points, for worlds with Bonds::watch_slips.
void record_slips(World& world);

}  // namespace crackle
