// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of a TOML text before its parser sees it: that one recurses by levels of tables, and a text of a few
// kilobytes has enough of them to use up the stack; and letters beyond ASCII lead it to where its authors say that it
// cannot come (toml++ 3.3, is_non_ascii_horizontal_whitespace()), while keys have none.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace crackle {

/// Bytes; no line of a case needs more.
inline constexpr int longest_toml_line = 10'000;
/// Dots of keys and opening brackets in one entry, `a.b = [{c = 1}]` has three. A case has at most two.
inline constexpr int deepest_toml_entry = 100;

/// @param name of the file. @throws InputError naming the line that is too long, too deep, or has such a letter
void check_toml_shape(const std::string& name, std::string_view text);

}  // namespace crackle
