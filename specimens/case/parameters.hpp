// SPDX-License-Identifier: GPL-3.0-or-later
// All parameters of a case, collected from specimen_keys.hpp and loading_keys.hpp. Only the case reader uses them.
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
/// Returns the parameter of a key, or nullptr if there is no such key.
const Parameter* find_parameter(const std::string& table, const std::string& key);

/// Alternative ways to state one quantity, each a list of full keys. If a file uses one alternative, values of the
/// other alternatives from included files are dropped.
using Alternatives = std::vector<std::vector<std::string>>;
/// Alternatives for all quantities that can be stated in several ways.
const std::vector<Alternatives>& case_alternatives();

/// Name and one-sentence description of a table.
struct TableDescription {
    std::string name;
    std::string sentence;
    // Only for tables that may occur several times, [[name]]:
    std::function<std::size_t(const TestCase&)> count = {};
    std::function<void(TestCase&, std::size_t)> set_count = {};

    /// Whether the table may occur several times.
    bool repeated() const { return static_cast<bool>(count); }
    /// Heading of the table in a case file.
    std::string heading() const { return repeated() ? "[[" + name + "]]" : "[" + name + "]"; }
};
/// All tables, in the order in which a case is written.
const std::vector<TableDescription>& case_tables();

/// Material of a mineral's grains: the keys of [material], overridden by the keys of the mineral.
TestCase::MaterialKeys mineral_material(const TestCase& test, std::size_t mineral);

/// Material of contacts between two minerals: the keys of the pair. Strengths and friction angles that the pair does
/// not set are those of the weaker mineral.
TestCase::MaterialKeys pair_material(const TestCase& test, std::size_t pair);
/// Keys of [material] that a [[mineral_pair]] may override.
const std::vector<std::string>& mineral_pair_keys();
/// The tables that hold keys of [material]: [material] itself, "mineral[1]", …, "mineral_pair[1]", …
std::vector<std::string> material_tables(const TestCase& test);

}  // namespace crackle
