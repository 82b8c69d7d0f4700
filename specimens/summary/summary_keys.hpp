// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of summary.json with their units and meanings, as the members of Summary declare them.
// Tested by tests/tools/readme_test.py and tests/specimens/summary/summary_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/quantity.hpp"
#include "specimens/summary/summary.hpp"

namespace crackle {

/// A key of summary.json.
struct SummaryKey {
    std::string name;
    std::string unit, meaning, more;  ///< members as in Quantity
    bool converted = false;           ///< whether the value is a stress or modulus, also given in Pa under ..._pa
    bool again = false;               ///< whether the key belongs to a type of table that has been listed before
};
/// The keys in file order. Keys in a table follow the table as `table.key`, with `*` for any name and `[]` for each
/// entry of a list. A key whose meaning depends on the test is listed once per meaning.
const std::vector<SummaryKey>& summary_keys();

/// Removes the suffix `_pa` of a converted value from a key, if it has this suffix.
std::string_view without_suffix(std::string_view key);

/// Unit and meaning as printed in summary.json. @param area_units  whether stresses are already in Pa
std::string stated_in(const Quantity& what, bool area_units);
/// Adds `units`, which lists the unit and meaning of each key present in the summary. Also adds the values of stresses
/// in Pa.
void state_units(Summary& summary);

}  // namespace crackle
