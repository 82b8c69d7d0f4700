// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of text as laboratories, spreadsheets and field tablets write them: values between commas, semicolons, tabs or
// blanks, blanks about them, quotes, empty lines and columns at the end, `#` in front of a remark. Nothing else is
// passed over: a value that is no number is refused with file and line, and a decimal comma by that name.
// Tested by tests/solver/files/table_reader_test.cpp.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/files/text_lines.hpp"

namespace crackle {

class TableReader {
  public:
    /// A list has no heading, lines of any number of values, and remarks behind values, too. Of words a line has one,
    /// which may have blanks and commas in it.
    enum class Form { table, list, words };

    /// @param name of the file, for messages @param text without byte order mark, which the caller keeps
    /// @param first_line number of its first line
    TableReader(std::string name, std::string_view text, Form form, int first_line = 1);

    /// Takes the next line as the names of the columns: every row then has as many values.
    /// @param expected of a heading, for the refusal of a file without a line
    void read_heading(const std::string& expected);
    const std::vector<std::string>& names() const { return names_; }
    /// Place of a column among the values of a row; nothing where there is none.
    /// @throws InputError if two columns have this name
    std::optional<std::size_t> column(std::string_view name) const;

    /// Goes to the next line with values. @return false behind the last one
    bool next();
    const std::vector<std::string_view>& values() const { return values_; }  ///< until the next call of next()
    /// A value as a finite number. @param what it is, for messages: "x", "size"
    double number(std::size_t place, std::string_view what) const;

    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
        lines_.refuse(found, expected);
    }
    [[noreturn]] void refuse_number(std::string_view word, const std::string& expected) const {
        lines_.refuse_number(word, expected);
    }
    const TextLines& lines() const { return lines_; }  ///< at this line, for messages
    const std::string& name() const { return lines_.name(); }
    int line() const { return lines_.line(); }
    std::string_view whole_line() const { return whole_; }  ///< with its remark

  private:
    /// The next line that is neither empty nor a remark, in values_. @return false behind the last one
    bool next_line();
    void split(std::string_view line);
    std::string_view quoted(std::string_view& rest);
    bool is_remark(std::string_view line);
    void require_as_many_as_names();

    TextLines lines_;
    Form form_;
    char separator_ = '\0';  ///< found by the first line; ' ' is any number of blanks, '\n' none
    std::string_view whole_;
    std::vector<std::string> names_;
    std::vector<std::string_view> values_;
    std::deque<std::string> unquoted_;  ///< values of this line with quotes within them
};

}  // namespace crackle
