// SPDX-License-Identifier: GPL-3.0-or-later
// Reads text tables as written by laboratories, spreadsheets and field tablets. Values are separated by commas,
// semicolons, tabs or spaces. Surrounding spaces, quotes, empty lines, empty columns at the end, and comments after `#`
// are accepted. Anything else that is not a number is refused, with file and line; if the cause is a decimal comma, the
// message says so.
// Tested by tests/solver/files/table_reader_test.cpp.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/files/text_lines.hpp"

namespace crackle {

/// Reads rows of numbers or words from a text. Error messages name file and line.
class TableReader {
  public:
    /// Layout of the text. A list has no heading and any number of values per line, and may have comments after values.
    /// With `words`, each line is one value, which may contain spaces and commas.
    enum class Form { table, list, words };

    /// @param name name of the file, for messages @param text without byte order mark; must outlive the reader
    /// @param first_line number of the text's first line in the file
    TableReader(std::string name, std::string_view text, Form form, int first_line = 1);

    /// Reads the next line as column names; every row must then have that number of values.
    /// @param expected description of the heading, for the message if there is no line
    void read_heading(const std::string& expected);
    /// Names of the columns, in file order; empty without a heading.
    const std::vector<std::string>& names() const { return names_; }
    /// Index of a column within a row; empty if there is no such column.
    /// @throws InputError if two columns have this name
    std::optional<std::size_t> column(std::string_view name) const;

    /// Moves to the next line with values. @return false at the end
    bool next();
    const std::vector<std::string_view>& values() const {
        return values_;
    }  ///< values of the current line, valid until the next call of next()
    /// A value as a finite number. @param what name of the value for messages, such as "x" or "size"
    double number(std::size_t place, std::string_view what) const;

    /// Refuses the current line. @throws InputError always: «file:line: found X, expected Y»
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
        lines_.refuse(found, expected);
    }
    /// Refuses a word of the current line that should be a number. @throws InputError always
    [[noreturn]] void refuse_number(std::string_view word, const std::string& expected) const {
        lines_.refuse_number(word, expected);
    }
    const TextLines& lines() const { return lines_; }  ///< positioned at the current line, for messages
    /// Name of the file for messages.
    const std::string& name() const { return lines_.name(); }
    /// Number of the current line, starting at 1.
    int line() const { return lines_.line(); }
    std::string_view whole_line() const { return whole_; }  ///< the current line, including its comment

  private:
    /// Reads the next line that is neither empty nor a comment into values_. @return false at the end
    bool next_line();
    void split(std::string_view line);
    std::string_view quoted(std::string_view& rest);
    bool is_remark(std::string_view line);
    void require_as_many_as_names();

    TextLines lines_;
    Form form_;
    /// Separator of the values, determined from the first line; ' ' stands for any number of spaces, '\n' for no
    /// separator.
    char separator_ = '\0';
    std::string_view whole_;
    std::vector<std::string> names_;
    std::vector<std::string_view> values_;
    std::deque<std::string> unquoted_;  ///< storage for the quoted values of the current line
};

}  // namespace crackle
