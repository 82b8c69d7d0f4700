// SPDX-License-Identifier: GPL-3.0-or-later
// How one parameter of a case is declared: its place, unit, range, sentence, and where TestCase holds it.
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

}  // namespace crackle
