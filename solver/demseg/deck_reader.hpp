// SPDX-License-Identifier: GPL-3.0-or-later
// Free-format numbers of a DEMseg file, one after the other, each with the line it stands on.
//
// As Fortran's list-directed READ: values are separated by any number of blanks and line breaks, and an exponent may be
// written with d, D, e or E. Unlike it, nothing is skipped: text that is no number, a missing value and a value too
// many are errors that name file, line and key, because a deck that is one value short shifts every number behind it.
// Tested by tests/solver/demseg/files_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace crackle {

class DeckReader {
  public:
    /// @param name used in messages, as the user would write the file's path.
    /// @param first_line of the text, in its file
    DeckReader(std::string name, std::string text, int first_line = 1);

    /// @throws InputError if the file cannot be read.
    static DeckReader open(const std::filesystem::path& path);

    /// Next value, finite. @param key what the deck calls it, for messages. @throws InputError
    double number(std::string_view key);
    double positive_number(std::string_view key);
    double number_not_negative(std::string_view key);
    /// Next value, a whole number in [lowest, highest]. @throws InputError
    std::int64_t integer(std::string_view key, std::int64_t lowest, std::int64_t highest);

    bool at_end();
    /// @throws InputError if anything follows. @param after what has just been read, e.g. "the last body".
    void expect_end(std::string_view after);

    /// Refuses the value read last. @throws InputError always: «file:line: key: found X, expected Y».
    [[noreturn]] void refuse(std::string_view key, std::string_view expected) const;
    /// The same with the finding in words.
    [[noreturn]] void refuse(std::string_view key, std::string_view found, std::string_view expected) const;

    const std::string& name() const { return name_; }
    std::string_view text() const { return text_; }  ///< all of it
    /// Line of the value read last, from 1.
    int line() const { return token_line_; }

  private:
    void skip_blanks();
    /// Next word, or InputError at the end of the file.
    std::string_view next(std::string_view key, std::string_view expected);

    std::string name_;
    std::string text_;
    std::string_view token_;  // into text_
    std::size_t position_ = 0;
    int line_;        // of position_
    int token_line_;  // of token_
};

}  // namespace crackle
