// SPDX-License-Identifier: GPL-3.0-or-later
// How one parameter of a case is declared. Used by the case reader alone; see parameters.cpp for the declarations.
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
#include <type_traits>
#include <vector>

#include "specimens/case/test_case.hpp"

namespace crackle {

enum class ValueKind { flag, integer, real, text, text_pair, reals };

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

    // Of a table that may come several times, entry is its place from 0; else it is not used.
    std::function<void(TestCase&, const CaseValue&, std::size_t entry)> set;
    std::function<std::optional<CaseValue>(const TestCase&, std::size_t entry)> get;
    std::function<void(TestCase&)> forget;  ///< makes an optional one absent; empty of the others

    std::string full_key() const { return table.empty() ? key : table + "." + key; }
    /// What is accepted, in words: "a number > 0 in m".
    std::string expected() const;
    /// Whether a number lies in the range, and is_a_size().
    bool accepts(double value) const;
};

/// All parameters, in the order in which a case is written.
const std::vector<Parameter>& case_parameters();
/// Nothing if there is no such key.
const Parameter* find_parameter(const std::string& table, const std::string& key);

/// Alternative keys for one quantity, each by its full keys. Where a file uses one, the others of the files it includes
/// go.
using Alternatives = std::vector<std::vector<std::string>>;
const std::vector<Alternatives>& case_alternatives();

/// A sentence about each table; the order of tables in a written case.
struct TableDescription {
    std::string name;
    std::string sentence;
    // Only of tables that may come several times, [[name]]:
    std::function<std::size_t(const TestCase&)> count = {};
    std::function<void(TestCase&, std::size_t)> set_count = {};

    bool repeated() const { return static_cast<bool>(count); }
    std::string heading() const { return repeated() ? "[[" + name + "]]" : "[" + name + "]"; }
};
const std::vector<TableDescription>& case_tables();

/// What a mineral's grains are made of: [material]'s keys with the mineral's own over them.
TestCase::MaterialKeys mineral_material(const TestCase& test, std::size_t mineral);

/// What a pair gives itself, and of strengths and friction the weaker mineral's where it does not.
TestCase::MaterialKeys pair_material(const TestCase& test, std::size_t pair);
/// Keys of [material] that a [[mineral_pair]] may override.
const std::vector<std::string>& mineral_pair_keys();
/// The tables that hold keys of [material]: that itself, "mineral[1]", …, "mineral_pair[1]", …
std::vector<std::string> material_tables(const TestCase& test);

}  // namespace crackle
