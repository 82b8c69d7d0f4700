// SPDX-License-Identifier: GPL-3.0-or-later
// What a file of results names: a column, an array or a key, declared once where it is written. The file's header,
// the `units` and `columns` of summary.json and the page specimens/results/FILES.md come from the declarations.
// Tested by tests/tools/readme_test.py.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crackle {

struct Quantity {
    const char* name;
    const char* unit;       ///< "-" for a pure number, "" for what is none
    const char* meaning;    ///< with the sign; summary.json states it behind the unit
    const char* more = "";  ///< printed in FILES.md only
};

/// As summary.json states it: "N/m, mean of both platens".
inline std::string stated(const Quantity& q) {
    const std::string unit = q.unit, meaning = q.meaning;
    return unit.empty() || meaning.empty() ? unit + meaning : unit + ", " + meaning;
}

/// @throws std::logic_error if nothing of that name is declared: what is written must be
inline const Quantity& declared(std::span<const Quantity> quantities, std::string_view name) {
    for (const Quantity& q : quantities)
        if (name == q.name) return q;
    throw std::logic_error("results: " + std::string(name) + " is written but not declared");
}

}  // namespace crackle
