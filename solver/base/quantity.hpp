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

/// A line of comma-separated values, with line end: text_of() of each column that is wanted.
template <class Columns, class Wanted, class TextOf>
std::string table_line(const Columns& columns, const Wanted& wanted, const TextOf& text_of) {
    std::string line;
    for (const auto& column : columns) {
        if (!wanted(column)) continue;
        if (!line.empty()) line += ',';
        line += text_of(column);
    }
    return line + '\n';
}

}  // namespace crackle
