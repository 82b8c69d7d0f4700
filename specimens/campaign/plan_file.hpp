// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a plan (plan.hpp) from its TOML file.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "specimens/campaign/plan.hpp"

namespace crackle {

/// Reads a plan and judges every point's keys and values.
/// @param with_companions rows of half the step and half the rate, too
/// @param most_rows values of an axis, points of a design, and tests in all
/// @throws InputError «file:line: key: found X, expected Y; what to do»
Plan read_plan(const std::filesystem::path& path, bool with_companions = false,
               std::int64_t most_rows = most_plan_rows);

/// Table of a plan's keys, for people.
std::string describe_plan_keys();

}  // namespace crackle
