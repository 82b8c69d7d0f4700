// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of summary.json: names, units, meanings.
// Tested by tests/tools/readme_test.py.
#pragma once

#include <vector>

#include "solver/base/quantity.hpp"

namespace crackle {

/// What a stress or modulus is called, and its unit, where out_of_plane_thickness has made it one of three dimensions.
inline constexpr const char* converted_suffix = "_pa";
inline constexpr const char* converted_unit = "Pa, the same over out_of_plane_thickness";

struct SummaryKey {
    Quantity what;
    bool in_units = true;    ///< stated in the file's own `units`
    bool converted = false;  ///< a stress or modulus: ..._pa stands beside it
};
/// In the order of the file. Keys of a table within stand behind it as `table.key`, `*` for any name and `[]` for each
/// entry of a list. A key whose meaning depends on the test stands once for each.
const std::vector<SummaryKey>& summary_keys();

}  // namespace crackle
