// SPDX-License-Identifier: GPL-3.0-or-later

#include "tools/commands/centre_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver/base/errors.hpp"

namespace crackle::tools {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    std::size_t at = line.find_first_not_of(blanks);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blanks, end);
    }
    return words;
}

/// Calls use(words, line number) for every line that holds words, until it returns false.
template <typename Use>
void each_line(std::string_view text, Use use) {
    int number = 0;
    while (!text.empty()) {
        ++number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto words = words_of(text.substr(0, end));
        if (!words.empty() && !use(words, number)) return;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

}  // namespace

bool parse_number(std::string_view word, double& value) {
    std::string spelled(word);
    std::replace_if(
        spelled.begin(), spelled.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const char* first = spelled.data() + (!spelled.empty() && spelled.front() == '+' ? 1 : 0);
    const char* last = spelled.data() + spelled.size();
    const auto [end, error] = std::from_chars(first, last, value);
    return error == std::errc{} && end == last && std::isfinite(value);
}

bool looks_like_centre_list(std::string_view text) {
    bool pair = false;
    each_line(text, [&pair](const std::vector<std::string_view>& words, int) {
        pair = words.size() == 2;
        return false;
    });
    return pair;
}

CentreList parse_centre_list(const std::string& name, std::string_view text) {
    CentreList list;
    each_line(text, [&](const std::vector<std::string_view>& words, int line) {
        if (words.size() != 2) {
            throw InputError(fmt::format("{}:{}: found {} word{}, expected two numbers x y", name, line, words.size(),
                                         words.size() == 1 ? "" : "s"));
        }
        Vec2 place;
        for (const auto& [word, value] : {std::pair{words[0], &place.x}, {words[1], &place.y}}) {
            if (!parse_number(word, *value)) {
                throw InputError(fmt::format("{}:{}: {}: found '{:.40}', expected a finite number", name, line,
                                             value == &place.x ? "x" : "y", word));
            }
        }
        list.places.push_back(place);
        list.lines.push_back(line);
        return true;
    });
    if (list.places.empty()) throw InputError(fmt::format("{}: found no centres, expected lines of x y", name));
    return list;
}

}  // namespace crackle::tools
