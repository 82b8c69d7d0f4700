// SPDX-License-Identifier: GPL-3.0-or-later
// Formats rows of words as a table with aligned columns, for terminals and text files.
// Tested by tests/solver/files/text_table_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/utf8.hpp"

namespace crackle {

/// Columns of words for a terminal, each as wide as its longest word.
class TextTable {
  public:
    /// @param sides alignment of each column, '<' or '>'
    explicit TextTable(std::string sides) : sides_(std::move(sides)) {}

    /// Adds a row. @param row one word per column; trailing empty words may be omitted
    void add(std::vector<std::string> row) {
        row.resize(sides_.size());
        rows_.push_back(std::move(row));
    }

    /// The table as text, one line per row, with two spaces at the start of each line and between columns, and no
    /// trailing spaces.
    std::string text() const {
        std::string text;
        for (const std::vector<std::string>& row : rows_) {
            std::string line;
            for (std::size_t column = 0; column < row.size(); ++column) {
                const std::string blanks(widest(column) - count_letters(row[column]), ' ');
                line += "  " + (sides_[column] == '<' ? row[column] + blanks : blanks + row[column]);
            }
            text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
        }
        return text;
    }

  private:
    std::size_t widest(std::size_t column) const {
        std::size_t most = 0;
        for (const std::vector<std::string>& row : rows_) most = std::max(most, count_letters(row[column]));
        return most;
    }

    std::string sides_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace crackle
