// SPDX-License-Identifier: GPL-3.0-or-later
// How one parameter of a case is declared. Used by the case reader alone; see parameters.cpp for the declarations.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "specimens/case/test_case.hpp"

namespace crackle {

/// A value as TOML knows it.
using CaseValue = std::variant<bool, std::int64_t, double, std::string>;

enum class ValueKind { flag, integer, real, text };

/// Who must write a key.
enum class Presence {
    required,             ///< every case
    required_with_table,  ///< every case that has the key's table
    optional,             ///< not required; absent means absent
    defaulted,            ///< not required; absent means the default
};

struct Parameter {
    std::string table;  ///< "" for keys at the top of the file
    std::string key;
    std::string unit;  ///< "" where there is none
    ValueKind kind = ValueKind::real;
    Presence presence = Presence::optional;
    std::optional<CaseValue> default_value;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowest_allowed = true, highest_allowed = true;
    std::vector<std::string> choices;  ///< of a text; empty: any
    bool is_path = false;
    std::string sentence;

    std::function<void(TestCase&, const CaseValue&)> set;
    std::function<std::optional<CaseValue>(const TestCase&)> get;
    std::function<void(TestCase&)> forget;  ///< makes an optional one absent; empty of the others

    std::string full_key() const { return table.empty() ? key : table + "." + key; }
    /// What is accepted, in words: "a number > 0 in m".
    std::string expected() const;
    /// Whether a number lies in the range (finite included).
    bool accepts(double value) const;
};

/// All parameters, in the order in which a case is written.
const std::vector<Parameter>& case_parameters();

/// Alternative keys for one quantity, each by its full keys. Where a file uses one, the others of the files it includes
/// go.
using Alternatives = std::vector<std::vector<std::string>>;
const std::vector<Alternatives>& case_alternatives();

/// A sentence about each table; the order of tables in a written case.
struct TableDescription {
    std::string name;
    std::string sentence;
};
const std::vector<TableDescription>& case_tables();

}  // namespace crackle
