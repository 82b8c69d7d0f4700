// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "solver/base/errors.hpp"

namespace crackle {

std::string_view stripped(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> number_of(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (word.starts_with('+') || word.empty()) return std::nullopt;
    std::string spelled;
    if (word.find_first_of("dD") != std::string_view::npos) {
        spelled = word;
        std::replace_if(
            spelled.begin(), spelled.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
        word = spelled;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

bool has_decimal_comma(std::string_view word) {
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos || word.find('.') != std::string_view::npos) return false;
    const auto is_digit = [&](std::size_t at) { return at < word.size() && word[at] >= '0' && word[at] <= '9'; };
    if (comma == 0 || !is_digit(comma - 1) || !is_digit(comma + 1)) return false;
    std::string spelled(word);
    spelled[comma] = '.';
    return number_of(spelled).has_value();
}

TextLines::TextLines(std::string name, std::string_view text, int first)
    : name_(std::move(name)), rest_(text), first_(first), line_(first - 1) {}

std::optional<std::string_view> TextLines::next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    if (line.size() > most_bytes_of_line) {
        ++line_;
        refuse(fmt::format("a line of {} bytes", line.size()),
               fmt::format("at most {}; save the file as text with line breaks", most_bytes_of_line));
    }
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    ++line_;
    return line;
}

void TextLines::refuse(const std::string& found, const std::string& expected) const {
    throw InputError(fmt::format("{}:{}: found {}, expected {}", name_, line(), found, expected));
}

void TextLines::refuse_number(std::string_view word, const std::string& expected) const {
    if (has_decimal_comma(word)) {
        refuse(fmt::format("'{:.40}', a number with a decimal comma", word),
               expected + "; save the file with decimal points");
    }
    refuse(fmt::format("'{:.40}'", word), expected);
}

}  // namespace crackle
