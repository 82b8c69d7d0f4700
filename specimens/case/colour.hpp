// SPDX-License-Identifier: GPL-3.0-or-later
// Colours as written in case files.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>

namespace crackle {

/// Converts "#rrggbb" to 0xrrggbb; empty for any other text.
inline std::optional<std::uint32_t> colour_of(const std::string& text) {
    const auto is_digit = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
    if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), is_digit)) return {};
    return static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
}

}  // namespace crackle
