// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the numbers of a DEMseg file one by one, as Fortran's list-directed READ does, and keeps track of line numbers.
//
// Values are separated by blanks, line ends or a comma. `3*0.0d0` stands for three values. An exponent is written with
// d, e or q, or without a letter (`.25+8`). The file ends at a Ctrl-Z. A READ takes as many lines as its values need,
// and the next READ starts on a new line (begin_read()). The rest of the last line is ignored and counts as a note.
// Numbers in notes are recorded for ignored_numbers(), because they could be surplus values. Unlike in Fortran, an
// omitted value (`,,` or an early `/`) is an error, and so are a missing value and text that is not a number. A
// full-width space counts as a blank. Notes may be in CP932 or UTF-8, whose characters contain no separator bytes.
// Tested by tests/solver/demseg/deck_reader_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crackle {

/// Reads the numbers of a deck one by one. Error messages name file and line.
class DeckReader {
  public:
    /// @param name path of the file for messages, as the user would write it
    /// @param first_line number of the text's first line in its file
    DeckReader(std::string name, std::string text, int first_line = 1);

    /// Opens a file. @throws InputError if it cannot be read
    static DeckReader open(const std::filesystem::path& path);

    /// Call this where DEMseg begins a new READ statement. If values were read since the last call, ignores the rest of
    /// the current line.
    void begin_read();
    /// Whether at least `count` more numbers follow on the current line.
    bool numbers_follow(int count) const;
    /// Ignores the rest of the file.
    void end_reads();
    /// A notice that lists the numbers that were ignored; empty if there were none.
    std::optional<std::string> ignored_numbers() const;

    /// Next value, which must be finite. @param key name of the value in the deck, for messages @throws InputError
    double number(std::string_view key);
    /// Next value, which must be > 0. @throws InputError
    double positive_number(std::string_view key);
    /// Next value, which must be >= 0. @throws InputError
    double number_not_negative(std::string_view key);
    /// Next value, which must be a whole number in [lowest, highest]. @throws InputError
    std::int64_t integer(std::string_view key, std::int64_t lowest, std::int64_t highest);

    /// Whether nothing but blanks and ignored text follows.
    bool at_end();
    /// Checks that nothing follows; for files written by this program. @param after description of the values read
    /// last, for example "the counts" @throws InputError if anything follows
    void expect_end(std::string_view after);

    /// Refuses the value read last. @throws InputError «file:line: key: found X, expected Y»
    [[noreturn]] void refuse(std::string_view key, std::string_view expected) const;
    /// Refuses the value read last. @param found description of what was found, for the message @throws InputError
    [[noreturn]] void refuse(std::string_view key, std::string_view found, std::string_view expected) const;

    /// Name of the file for messages.
    const std::string& name() const { return name_; }
    std::string_view text() const { return text_; }  ///< the whole text
    /// Line number of the value read last, starting at 1.
    int line() const { return token_line_; }

  private:
    void skip_blanks();
    /// Next word. @throws InputError at the end of the file
    std::string_view next(std::string_view key, std::string_view expected);
    void take_repeats(std::string_view key, std::string_view expected);
    void ignore_rest_of_line();
    void ignore_number(std::string_view word);
    /// Message text about the last ignored number, which may be the cause of an error.
    std::string last_ignored_text() const;

    std::string name_;
    std::string text_;
    std::string_view token_;  // points into text_
    std::size_t position_ = 0;
    int line_;        // line number of position_
    int token_line_;  // line number of token_

    std::int64_t repeats_left_ = 0;  // number of further values for which token_ stands
    bool begun_ = false;             // whether a value of the current READ has been read
    bool comma_may_follow_ = false;

    std::int64_t ignored_count_ = 0;
    std::vector<std::string> first_ignored_;  // the first ignored numbers, with their line numbers
    std::string last_ignored_;
};

}  // namespace crackle
