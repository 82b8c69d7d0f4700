// SPDX-License-Identifier: GPL-3.0-or-later
// Code points of UTF-8 text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace crackle {

/// The code point at the start of a text.
struct Letter {
    std::size_t bytes;   ///< number of bytes; 0 if the text does not begin with valid UTF-8
    std::uint32_t code;  ///< code point, or the first byte if the text does not begin with valid UTF-8
};

/// First code point of a non-empty text. Overlong forms, surrogates and code points above U+10FFFF are invalid.
Letter first_letter(std::string_view text);

/// Number of code points in a valid text.
std::size_t count_letters(std::string_view text);

}  // namespace crackle
