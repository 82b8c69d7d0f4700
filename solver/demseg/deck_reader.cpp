// SPDX-License-Identifier: GPL-3.0-or-later
// See deck_reader.hpp.

#include "solver/demseg/deck_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/text_lines.hpp"

namespace crackle {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// Long words (a binary file, say) are cut in messages.
std::string quoted(std::string_view word) {
    constexpr std::size_t shown = 40;
    return word.size() <= shown ? fmt::format("'{}'", word) : fmt::format("'{}...'", word.substr(0, shown));
}

}  // namespace

DeckReader::DeckReader(std::string name, std::string text, int first_line)
    : name_(std::move(name)), text_(std::move(text)), line_(first_line), token_line_(first_line) {
    position_ = text_.size() - without_byte_order_mark(text_).size();
}

DeckReader DeckReader::open(const std::filesystem::path& path) { return {path.string(), read_text(path)}; }

void DeckReader::skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) {
        if (text_[position_] == '\n') ++line_;
        ++position_;
    }
}

std::string_view DeckReader::next(std::string_view key, std::string_view expected) {
    skip_blanks();
    if (position_ == text_.size()) {
        throw InputError(
            fmt::format("{}:{}: {}: found the end of the file, expected {}; the file is cut off or a count "
                        "in it is too large",
                        name_, line_, key, expected));
    }
    const std::size_t start = position_;
    while (position_ < text_.size() && !is_blank(text_[position_])) ++position_;
    token_line_ = line_;
    token_ = std::string_view(text_).substr(start, position_ - start);
    return token_;
}

void DeckReader::refuse(std::string_view key, std::string_view expected) const {
    refuse(key, quoted(token_), expected);
}

void DeckReader::refuse(std::string_view key, std::string_view found, std::string_view expected) const {
    throw InputError(fmt::format("{}:{}: {}: found {}, expected {}", name_, token_line_, key, found, expected));
}

double DeckReader::number(std::string_view key) {
    const std::optional<double> value = number_of(next(key, "a number"));
    if (!value || !std::isfinite(*value)) refuse(key, "a finite number such as 2.5, 1e8 or 1.0d8");
    return *value;
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
    skip_blanks();
    return position_ == text_.size();
}

void DeckReader::expect_end(std::string_view after) {
    if (at_end()) return;
    next("", "");
    refuse("end of file", fmt::format("{} after {}", quoted(token_), after),
           "nothing more; a count further up is too small or a line has a value too many");
}

}  // namespace crackle
