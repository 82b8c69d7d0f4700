// SPDX-License-Identifier: GPL-3.0-or-later
// A text line by line, and a word of it as a number: what every reader of text begins with.
// Tested by tests/solver/files/table_reader_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace crackle {

/// Without blanks and tabs at both ends.
std::string_view stripped(std::string_view text);

/// A whole word as a number. A plus sign and a Fortran exponent (1d3) are understood; infinite and "nan" are numbers
/// here, for those who have a use for them. @return nothing if it is none, or beyond the range of a double
std::optional<double> number_of(std::string_view word);

/// Whether a word is a number with a decimal comma (1,5): no number here, but worth naming.
bool has_decimal_comma(std::string_view word);

/// Lines that end by LF, CR LF or CR alone.
class TextLines {
  public:
    /// @param name of the file, for messages @param text which the caller keeps @param first number of its first line
    TextLines(std::string name, std::string_view text, int first = 1);

    /// The next line, or nothing behind the last one.
    std::optional<std::string_view> next();

    /// @throws InputError «file:line: found X, expected Y»
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    /// Refuses a word that is no number; a decimal comma is named. @param expected what it should be
    [[noreturn]] void refuse_number(std::string_view word, const std::string& expected) const;

    const std::string& name() const { return name_; }
    int line() const { return line_ < first_ ? first_ : line_; }  ///< of what next() has given

  private:
    std::string name_;
    std::string_view rest_;
    int first_, line_;
};

}  // namespace crackle
