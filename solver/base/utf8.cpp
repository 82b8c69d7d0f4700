// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/utf8.hpp"

#include <algorithm>

namespace crackle {
namespace {

bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U; }

}  // namespace

Letter first_letter(std::string_view text) {
    const std::uint32_t head = static_cast<unsigned char>(text[0]);
    if (head < 0x80U) return {1, head};
    const std::size_t length = head >= 0xf0U ? 4 : head >= 0xe0U ? 3 : 2;
    if (head < 0xc2U || head > 0xf4U || text.size() < length) return {0, head};
    std::uint32_t code = head & (0x7fU >> length);
    for (std::size_t k = 1; k < length; ++k) {
        if (!continues_letter(text[k])) return {0, head};
        code = code << 6U | (static_cast<unsigned char>(text[k]) & 0x3fU);
    }
    constexpr std::uint32_t least[] = {0x80U, 0x800U, 0x10000U};
    const bool surrogate = code >= 0xd800U && code < 0xe000U;
    if (code < least[length - 2] || code > 0x10ffffU || surrogate) return {0, head};
    return {length, code};
}

std::size_t count_letters(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_letter));
}

}  // namespace crackle
