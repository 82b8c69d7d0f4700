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

/// Reads a plan and judges every point's keys and values.
/// @param with_companions rows of half the step and half the rate, too
/// @param most_rows values of an axis, points of a design, and tests in all
/// @throws InputError «file:line: key: found X, expected Y; what to do»
Plan read_plan(const std::filesystem::path& path, bool with_companions = false,
               std::int64_t most_rows = most_plan_rows);

/// The [[test]]s of a file, a plan or another: name, case, set. @throws InputError, also for none, or two of one name
std::vector<PlannedTest> read_planned_tests(const KeyedFile& file);

/// What `key` of a table names: a key of a case, "material.cohesion". @throws InputError where there is no such key
std::pair<std::string, const Parameter*> read_case_key(const KeyedTable& table);

/// Table of a plan's keys, for people.
std::string describe_plan_keys();

}  // namespace crackle
