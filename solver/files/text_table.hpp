// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of words as columns that never run together, whatever the words: a terminal's table, a text file's.
// Tested by tests/solver/files/text_table_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace crackle {

class TextTable {
  public:
    /// @param sides  of each column, '<' or '>': where its words stand
    explicit TextTable(std::string sides) : sides_(std::move(sides)) {}

    /// @param row  a word for each column; empty ones at its end may be left out
    void add(std::vector<std::string> row) {
        row.resize(sides_.size());
        rows_.push_back(std::move(row));
    }

    /// Each row in a line, two blanks before it and between its columns, none at its end.
    std::string text() const {
        std::string text;
        for (const std::vector<std::string>& row : rows_) {
            std::string line;
            for (std::size_t column = 0; column < row.size(); ++column) {
                const std::string blanks(widest(column) - letters(row[column]), ' ');
                line += "  " + (sides_[column] == '<' ? row[column] + blanks : blanks + row[column]);
            }
            text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
        }
        return text;
    }

  private:
    /// Letters, not bytes of UTF-8.
    static std::size_t letters(const std::string& word) {
        return static_cast<std::size_t>(
            std::ranges::count_if(word, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
    }
    std::size_t widest(std::size_t column) const {
        std::size_t most = 0;
        for (const std::vector<std::string>& row : rows_) most = std::max(most, letters(row[column]));
        return most;
    }

    std::string sides_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace crackle
