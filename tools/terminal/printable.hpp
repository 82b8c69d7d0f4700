// SPDX-License-Identifier: GPL-3.0-or-later
// Makes text safe to print on a terminal. Titles, names, paths and contents of files may contain anything, including
// terminal control sequences.
// Tested by tests/tools/terminal/printable_test.cpp.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace crackle::tools {

/// The text with all control characters escaped, except newlines and tabs. C0 characters are written like \x1b. DEL
/// and C1 characters are written like \u009b, so that JSON remains valid. Bytes that are not valid UTF-8 are written
/// like \x9b.
std::string printable(std::string_view text);

/// Prints results to standard output in printable form. Commands print results only through this function and
/// print_out().
void print_text(std::string_view text);

/// Prints the result of fmt::format() in printable form.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
    print_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Prints text for another program, such as a script: unchanged, except on a terminal, where it is made printable.
void print_bytes(std::string_view bytes);

}  // namespace crackle::tools
