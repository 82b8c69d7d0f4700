// SPDX-License-Identifier: GPL-3.0-or-later
// All parameters of a case: what the declarations of specimen_keys.hpp and loading_keys.hpp come to. Used by the case
// reader alone.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "specimens/case/parameter.hpp"
#include "specimens/case/test_case.hpp"

namespace crackle {

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
