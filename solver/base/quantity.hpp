// SPDX-License-Identifier: GPL-3.0-or-later
// A named quantity in a results file (column, array or key), declared once in the code that writes it. The file's
// header, `units` and `columns` in summary.json, and the page specimens/results/FILES.md are generated from the
// declarations. Tested by tests/tools/readme_test.py.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crackle {

/// Declaration of a column, key or array: name, unit and meaning.
struct Quantity {
    const char* name;
    const char* unit;       ///< "-" for a dimensionless number, "" for a value that is not a number
    const char* meaning;    ///< includes the sign convention; summary.json prints it after the unit
    const char* more = "";  ///< additional text, printed only in FILES.md
};

/// Unit and meaning as printed in summary.json: "N/m, mean of both platens".
inline std::string stated(const Quantity& q) {
    const std::string unit = q.unit, meaning = q.meaning;
    return unit.empty() || meaning.empty() ? unit + meaning : unit + ", " + meaning;
}

/// Finds the declaration of a name. @throws std::logic_error if there is none: every quantity that is written must be
/// declared
inline const Quantity& declared(std::span<const Quantity> quantities, std::string_view name) {
    for (const Quantity& q : quantities)
        if (name == q.name) return q;
    throw std::logic_error("results: " + std::string(name) + " is written but not declared");
}

/// One line of comma-separated values, with a newline at the end. It contains text_of(column) for each column for which
/// wanted(column) is true.
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
