// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a text into lines and converts words to numbers, for all readers of text.
// Tested by tests/solver/files/table_reader_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace crackle {

/// The text without leading and trailing spaces and tabs.
std::string_view stripped(std::string_view text);

/// Converts a word to a number. A plus sign, a Fortran exponent (1d3), infinity and "nan" are accepted. @return empty
/// if the word is not a number, or is beyond the range of a double
std::optional<double> number_of(std::string_view word);

/// Whether a word is a number with a decimal comma (1,5). Such numbers are refused, with a hint in the message.
bool has_decimal_comma(std::string_view word);

inline constexpr std::size_t most_bytes_of_line = 1'000'000;

/// Reads lines that end with LF, CR LF or CR alone.
class TextLines {
  public:
    /// @param name name of the file, for messages @param text must outlive this object @param first line number of the
    /// first line of the text
    TextLines(std::string name, std::string_view text, int first = 1);

    /// The next line, or empty. @throws InputError if a line is longer than the limit
    std::optional<std::string_view> next();

    /// Refuses the current line. @throws InputError «file:line: found X, expected Y»
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    /// Refuses a word that is not a number. If it has a decimal comma, the message says so. @param expected description
    /// of a valid word
    [[noreturn]] void refuse_number(std::string_view word, const std::string& expected) const;

    /// Name of the file for messages.
    const std::string& name() const { return name_; }
    int line() const { return line_ < first_ ? first_ : line_; }  ///< number of the line last returned by next()

  private:
    std::string name_;
    std::string_view rest_;
    int first_, line_;
};

}  // namespace crackle
