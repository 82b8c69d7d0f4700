// SPDX-License-Identifier: GPL-3.0-or-later
// What the units of particle files and decks are called, which do not state them: any consistent set will do. Times are
// in s and angles in rad in all sets. Strictly 2D: forces, energies and masses are those of a slice of unit thickness.
// Tested by tests/tools/commands/plot_decks_test.cpp.
#pragma once

#include <string>
#include <vector>

namespace crackle {

struct UnitNames {
    std::string length, velocity, force, energy;
    std::string stress;     ///< force over length
    bool prefixes = false;  ///< kN, mm: the units are those that prefixes go with
};

/// si, cgs, mm-g-s.
const std::vector<std::string>& unit_sets();
/// @param where  for the message, "view: --units" @throws InputError for another than one of these sets
UnitNames units_named(const std::string& where, const std::string& name);

}  // namespace crackle
