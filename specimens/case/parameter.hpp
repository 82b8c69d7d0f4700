// SPDX-License-Identifier: GPL-3.0-or-later
// Declaration of one parameter of a case: table, key, unit, range, description, and the member of TestCase that stores
// the value.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace crackle {

struct TestCase;

/// Value of a key: one of the types that TOML provides.
using CaseValue =
    std::variant<bool, std::int64_t, double, std::string, std::array<std::string, 2>, std::vector<double>>;

/// Type of a value in a case file.
enum class ValueKind { flag, integer, real, text, text_pair, reals };

/// Whether a key must be written.
enum class Presence {
    required,             ///< in every case
    required_with_table,  ///< in every case that has the key's table
    optional,             ///< not required and without a default
    defaulted,            ///< not required, with a default
};

/// A key of a case: what it accepts, and the member that it sets.
struct Parameter {
    std::string table;  ///< "" for keys at the top of the file
    std::string key;
    std::string unit;  ///< "" for a key without a unit
    ValueKind kind = ValueKind::real;
    Presence presence = Presence::optional;
    std::optional<CaseValue> default_value;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowest_allowed = true, highest_allowed = true;
    std::vector<std::string> choices;  ///< allowed texts; empty if any text is allowed
    bool is_path = false;
    std::string sentence;

    // `entry` is the zero-based index of a table that may occur several times; otherwise it is unused.
    std::function<void(TestCase&, const CaseValue&, std::size_t entry)> set;
    std::function<std::optional<CaseValue>(const TestCase&, std::size_t entry)> get;
    std::function<void(TestCase&)> forget;  ///< removes the value of an optional key; empty for other keys

    /// Table and key, as in "material.cohesion".
    std::string full_key() const { return table.empty() ? key : table + "." + key; }
    /// Description of the accepted values, such as "a number > 0 in m".
    std::string expected() const;
    /// Whether a number lies in the key's range and satisfies is_a_size().
    bool accepts(double value) const;
};

}  // namespace crackle
