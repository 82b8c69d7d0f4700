// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a DEMseg file, one after the other, each with the line it stands on, as Fortran's list-directed READ takes
// them.
//
// Blanks, line ends or a comma separate values; `3*0.0d0` is three; an exponent is written with d, e or q, or without a
// letter (`.25+8`); the file ends at a Ctrl-Z. A READ takes as many lines as its values need, and the next one starts
// on a new line (begin_read()). What is left of a line is a note. Numbers in notes are kept for ignored_numbers(),
// because a value too many looks the same. Unlike in Fortran a value left out (`,,` or an early `/`) is an error, like
// text that is no number and a missing value; and a full-width blank is a blank. Notes may be in CP932 or UTF-8: no
// byte of their letters is a separator. Tested by tests/solver/demseg/deck_reader_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crackle {

class DeckReader {
  public:
    /// @param name used in messages, as the user would write the file's path.
    /// @param first_line of the text, in its file
    DeckReader(std::string name, std::string text, int first_line = 1);

    /// @throws InputError if the file cannot be read.
    static DeckReader open(const std::filesystem::path& path);

    /// Begins DEMseg's next READ, on a new line: what the last one left of its line is ignored.
    void begin_read();
    /// Whether `count` more numbers stand on the present line.
    bool numbers_follow(int count) const;
    /// Ignores the rest of the file.
    void end_reads();
    /// A notice of the numbers that were ignored; nothing without any.
    std::optional<std::string> ignored_numbers() const;

    /// Next value, finite. @param key what the deck calls it, for messages. @throws InputError
    double number(std::string_view key);
    double positive_number(std::string_view key);
    double number_not_negative(std::string_view key);
    /// Next value, a whole number in [lowest, highest]. @throws InputError
    std::int64_t integer(std::string_view key, std::int64_t lowest, std::int64_t highest);

    bool at_end();
    /// @throws InputError if anything follows, as in files that the program writes nothing may. @param after what has
    /// just been read, e.g. "the counts".
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
    void take_repeats(std::string_view key, std::string_view expected);
    void ignore_rest_of_line();
    void ignore_number(std::string_view word);
    /// What an error says of the last ignored number, which may be its cause.
    std::string last_ignored_text() const;

    std::string name_;
    std::string text_;
    std::string_view token_;  // into text_
    std::size_t position_ = 0;
    int line_;        // of position_
    int token_line_;  // of token_

    std::int64_t repeats_left_ = 0;  // of token_
    bool begun_ = false;             // a value of the present READ was taken
    bool comma_may_follow_ = false;

    std::int64_t ignored_count_ = 0;
    std::vector<std::string> first_ignored_;  // with their lines
    std::string last_ignored_;
};

}  // namespace crackle
