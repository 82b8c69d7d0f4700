// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the structure of a TOML text before it is parsed. The parser recurses once per nested table, so a text of a
// few kilobytes could overflow the stack. Non-ASCII letters outside quotes lead the parser to code that its authors
// regard as unreachable (toml++ 3.3, is_non_ascii_horizontal_whitespace()). No key of a case contains such letters.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace crackle {

/// Largest length of a line in bytes; no line of a case needs more.
inline constexpr int longest_toml_line = 10'000;
/// Largest number of dots and opening brackets in one entry; `a.b = [{c = 1}]` has three. A case has at most two.
inline constexpr int deepest_toml_entry = 100;

/// Checks the structure of a text. @param name  the name of the file @throws InputError naming a line that is too long,
/// is nested too deeply, or contains a non-ASCII letter outside quotes
void check_toml_shape(const std::string& name, std::string_view text);

}  // namespace crackle
