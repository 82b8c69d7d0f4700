// SPDX-License-Identifier: GPL-3.0-or-later
// How it is known that a test's results are being replaced: OUT.new, where the new ones grow, has a file that says so.
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

inline constexpr const char* staging_suffix = ".new";
/// In OUT.new: a forced test's own, to be begun again.
inline constexpr const char* staged_mark = "replaces-older-results";
/// First line of the mark once the results are complete and take the old ones' place; names of their frames follow.
inline constexpr const char* moving_line = "complete, being moved";

/// Lines behind the first of the mark in a folder where new results lie that are being moved; none: nothing is.
bool is_being_moved(const std::filesystem::path& working, std::string& frames);

/// @throws InputError if a folder holds results of which some are a new test's and some the one's before
void refuse_half_replaced(const std::filesystem::path& folder);

}  // namespace crackle
