// SPDX-License-Identifier: GPL-3.0-or-later
// Names of units for particle files and decks, which may use any consistent unit system and do not state it. Times are
// in s and angles in rad in all systems. Since models are two-dimensional, forces, energies and masses refer to a slice
// of unit thickness.
// Tested by tests/tools/commands/plot_decks_test.cpp.
#pragma once

#include <string>
#include <vector>

namespace crackle {

/// Names of the units of a recording.
struct UnitNames {
    std::string length, velocity, force, energy;
    std::string stress;     ///< force per length
    bool prefixes = false;  ///< whether units take prefixes, as in kN and mm
};

/// Names of the unit systems: si, cgs, mm-g-s.
const std::vector<std::string>& unit_sets();
/// The units of a system.
/// @param where  start of the message, such as "view: --units"
/// @throws InputError if there is no unit system of this name
UnitNames units_named(const std::string& where, const std::string& name);

}  // namespace crackle
