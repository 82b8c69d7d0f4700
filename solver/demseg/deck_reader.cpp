// SPDX-License-Identifier: GPL-3.0-or-later
// See deck_reader.hpp.

#include "solver/demseg/deck_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/utf8.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/text_lines.hpp"

namespace crackle {
namespace {

constexpr std::size_t most_ignored_shown = 3;
constexpr std::int64_t most_repeats = std::numeric_limits<int>::max();

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// Length in bytes of the blank at `at`, or 0. Full-width spaces are included, since Japanese editors
/// easily leave them after values.
std::size_t blank_at(std::string_view text, std::size_t at) {
    if (is_blank(text[at])) return 1;
    if (text[at] == '\xe3') return text.substr(at, 3) == "\xe3\x80\x80" ? 3 : 0;  // UTF-8
    if (text[at] == '\x81') return text.substr(at, 2) == "\x81\x40" ? 2 : 0;      // CP932
    return 0;
}

/// The word that starts at `at` and ends before the next separator; empty if there is a separator at `at`.
std::string_view word_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && text[end] != ',' && text[end] != '/' && blank_at(text, end) == 0) ++end;
    return text.substr(at, end - at);
}

/// The word in quotes, for a message. Long words (for example, from a binary file) are shortened; bytes that cannot be
/// displayed are written as \x93.
std::string quoted(std::string_view word) {
    constexpr std::size_t shown = 40;
    std::string text;
    std::size_t at = 0;
    while (at < std::min(word.size(), shown)) {
        const auto [bytes, code] = first_letter(word.substr(at));
        const bool shows = bytes > 0 && code >= 0x20 && code != 0x7f;
        text += shows ? std::string(word.substr(at, bytes)) : fmt::format("\\x{:02x}", code);
        at += std::max<std::size_t>(bytes, 1);
    }
    return fmt::format("'{}{}'", text, at < word.size() ? "..." : "");
}

/// Converts a Fortran real to a double. @return false if the word is not a number or is out of range
bool parse_number(std::string_view word, double& value) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
        if (word.starts_with('-')) return false;
    }
    // The only letters accepted are those that begin an exponent, because from_chars would also accept "inf" and "nan".
    std::string plain;
    for (char c : word) {
        if (c == 'd' || c == 'D' || c == 'E' || c == 'q' || c == 'Q') c = 'e';
        const bool sign = c == '+' || c == '-';
        if (c != 'e' && c != '.' && !sign && (c < '0' || c > '9')) return false;
        if (sign && !plain.empty() && plain.back() != 'e') plain += 'e';  // exponent without a letter, as in .25+8
        plain += c;
    }
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    return error == std::errc() && end == plain.data() + plain.size();
}

/// Splits a word such as `3*0.5` into its count and its value. Without a star the count is 1; an invalid count gives 0.
std::pair<std::int64_t, std::string_view> repeated(std::string_view word) {
    const std::size_t star = word.find('*');
    if (star == std::string_view::npos) return {1, word};
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + star, count);
    const bool counted = error == std::errc() && end == word.data() + star && count > 0 && count <= most_repeats;
    return {counted ? count : 0, word.substr(star + 1)};
}

/// Number of values in a word: 1, a repeat count, or 0 if it is not a number.
std::int64_t numbers_in(std::string_view word) {
    const auto [count, number] = repeated(word);
    double value = 0.0;
    return parse_number(number, value) ? count : 0;
}

}  // namespace

DeckReader::DeckReader(std::string name, std::string text, int first_line)
    : name_(std::move(name)), text_(std::move(text)), line_(first_line), token_line_(first_line) {
    position_ = text_.size() - without_byte_order_mark(text_).size();
    constexpr char ctrl_z = '\x1a';  // DOS end-of-file mark
    text_.resize(std::min(text_.find(ctrl_z), text_.size()));
}

DeckReader DeckReader::open(const std::filesystem::path& path) { return {path.string(), read_text(path)}; }

void DeckReader::skip_blanks() {
    while (position_ < text_.size()) {
        const std::size_t blank = blank_at(text_, position_);
        if (blank == 0) return;
        if (text_[position_] == '\n') ++line_;
        position_ += blank;
    }
}

std::string_view DeckReader::next(std::string_view key, std::string_view expected) {
    if (repeats_left_ > 0) {
        --repeats_left_;
        return token_;
    }
    skip_blanks();
    if (comma_may_follow_ && position_ < text_.size() && text_[position_] == ',') {
        ++position_;
        skip_blanks();
    }
    if (position_ == text_.size()) {
        throw InputError(
            fmt::format("{}:{}: {}: found the end of the file, expected {}; the file is cut off or a count "
                        "in it is too large{}",
                        name_, line_, key, expected, last_ignored_text()));
    }
    token_line_ = line_;
    token_ = word_at(text_, position_);
    if (token_.empty()) {
        refuse(key, text_[position_] == '/' ? "'/', which ends the values of a READ" : "',' without a value before it",
               expected);
    }
    position_ += token_.size();
    begun_ = comma_may_follow_ = true;
    take_repeats(key, expected);
    return token_;
}

void DeckReader::take_repeats(std::string_view key, std::string_view expected) {
    const auto [count, word] = repeated(token_);
    if (count == 0 || word.empty()) refuse(key, expected);
    repeats_left_ = count - 1;
    token_ = word;
}

void DeckReader::ignore_number(std::string_view word) {
    last_ignored_ = fmt::format("{} in line {}", quoted(word), line_);
    if (first_ignored_.size() < most_ignored_shown) first_ignored_.push_back(last_ignored_);
}

void DeckReader::ignore_rest_of_line() {
    if (repeats_left_ > 0) ignore_number(token_);
    ignored_count_ += std::exchange(repeats_left_, 0);
    const std::string_view line =
        std::string_view(text_).substr(0, std::min(text_.find('\n', position_), text_.size()));
    bool first = true;
    while (position_ < line.size()) {
        // A slash that ends the values of a READ starts a note, in which numbers are not recorded.
        if (first && line[position_] == '/') break;
        const std::string_view word = word_at(line, position_);
        if (word.empty()) {
            position_ += std::max<std::size_t>(blank_at(line, position_), 1);
            continue;
        }
        first = false;
        if (const std::int64_t count = numbers_in(word); count > 0) {
            ignore_number(word);
            ignored_count_ += count;
        }
        position_ += word.size();
    }
    position_ = line.size();
    if (position_ == text_.size()) return;
    ++position_;
    ++line_;
}

void DeckReader::begin_read() {
    if (begun_) ignore_rest_of_line();
    begun_ = comma_may_follow_ = false;
}

bool DeckReader::numbers_follow(int count) const {
    std::int64_t left = count - repeats_left_;
    for (std::size_t at = position_; left > 0 && at < text_.size() && text_[at] != '\n' && text_[at] != '/';) {
        const std::string_view word = word_at(text_, at);
        const std::int64_t numbers = word.empty() ? 0 : numbers_in(word);
        if (!word.empty() && numbers == 0) return false;
        left -= numbers;
        at += word.empty() ? std::max<std::size_t>(blank_at(text_, at), 1) : word.size();
    }
    return left <= 0;
}

void DeckReader::end_reads() {
    do ignore_rest_of_line();
    while (position_ < text_.size());
}

std::optional<std::string> DeckReader::ignored_numbers() const {
    if (ignored_count_ == 0) return std::nullopt;
    const auto more = ignored_count_ - static_cast<std::int64_t>(first_ignored_.size());
    return fmt::format(
        "{}: numbers after the last value of a READ are ignored, as DEMseg does: {}{}; if they are not notes, a line "
        "has too many values or a count is too small",
        name_, fmt::join(first_ignored_, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string DeckReader::last_ignored_text() const {
    if (last_ignored_.empty()) return "";
    return fmt::format("; before that, {} was ignored, because each READ of DEMseg starts on a new line",
                       last_ignored_);
}

void DeckReader::refuse(std::string_view key, std::string_view expected) const {
    refuse(key, quoted(token_), expected);
}

void DeckReader::refuse(std::string_view key, std::string_view found, std::string_view expected) const {
    throw InputError(fmt::format("{}:{}: {}: found {}, expected {}{}", name_, token_line_, key, found, expected,
                                 last_ignored_text()));
}

double DeckReader::number(std::string_view key) {
    constexpr std::string_view expected = "a finite number such as 2.5, 1e8 or 1.0d8";
    double value = 0.0;
    if (!parse_number(next(key, "a number"), value) || !std::isfinite(value)) refuse(key, expected);
    return value;
}

double DeckReader::positive_number(std::string_view key) {
    const double value = number(key);
    if (!(value > 0.0)) refuse(key, "a number > 0");
    return value;
}

double DeckReader::number_not_negative(std::string_view key) {
    const double value = number(key);
    if (!(value >= 0.0)) refuse(key, "a number >= 0");
    return value;
}

std::int64_t DeckReader::integer(std::string_view key, std::int64_t lowest, std::int64_t highest) {
    std::string_view word = next(key, "a whole number");
    if (word.starts_with('+')) word.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < lowest || value > highest) {
        refuse(key, lowest == highest ? fmt::format("{}", lowest)
                                      : fmt::format("a whole number from {} to {}", lowest, highest));
    }
    return value;
}

bool DeckReader::at_end() {
    if (repeats_left_ > 0) return false;
    skip_blanks();
    return position_ == text_.size();
}

void DeckReader::expect_end(std::string_view after) {
    if (at_end()) return;
    if (repeats_left_ == 0) {
        token_line_ = line_;
        const std::string_view word = word_at(text_, position_);
        token_ = word.empty() ? std::string_view(text_).substr(position_, 1) : word;
    }
    refuse("end of file", fmt::format("{} after {}", quoted(token_), after),
           "nothing more; a count further up is too small or a line has too many values");
}

}  // namespace crackle
