// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a plan (plan.hpp) from its TOML file.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "specimens/campaign/plan.hpp"

namespace crackle {

class KeyedFile;
class KeyedTable;

/// Reads a plan and checks the keys and values of every point.
/// @param with_companions  whether to add rows with half the time step and half the rate
/// @param most_rows  largest number of values of an axis, of points of a design, and of tests in total
/// @throws InputError «file:line: key: found X, expected Y; what to do»
Plan read_plan(const std::filesystem::path& path, bool with_companions = false,
               std::int64_t most_rows = most_plan_rows);

/// Reads the [[test]] tables of a plan or another file: name, case, set.
/// @throws InputError, also if there is no such table or a name is repeated
std::vector<PlannedTest> read_planned_tests(const KeyedFile& file);

/// The key of a case, such as "material.cohesion", that is named by entry `key` of a table.
/// @throws InputError if a case has no such key
std::pair<std::string, const Parameter*> read_case_key(const KeyedTable& table);

/// Formats the keys of a plan as a table for users.
std::string describe_plan_keys();

}  // namespace crackle
