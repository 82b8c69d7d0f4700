// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/base64.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace crackle {
namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t not_a_letter = 255;

constexpr std::array<std::uint8_t, 256> make_values() {
    std::array<std::uint8_t, 256> values{};
    values.fill(not_a_letter);
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
    }
    return values;
}

constexpr std::array<std::uint8_t, 256> digit_values = make_values();

}  // namespace

std::string encode_base64(std::span<const unsigned char> bytes) {
    // OpenSSL takes int lengths and appends a zero byte. Pieces therefore consist of whole groups of three bytes, and
    // the buffer has room for one more character.
    constexpr std::size_t piece = 3 << 24;
    const std::size_t letters = (bytes.size() + 2) / 3 * 4;
    std::string text(letters + 1, '\0');
    std::size_t written = 0;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        const auto count = static_cast<int>(std::min(piece, bytes.size() - at));
        written += static_cast<std::size_t>(
            EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + written), bytes.data() + at, count));
    }
    text.resize(letters);
    return text;
}

std::optional<std::vector<unsigned char>> decode_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    std::size_t padding = 0;
    while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;

    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (std::size_t at = 0; at < text.size(); at += 4) {
        const bool last = at + 4 == text.size();
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool pad = last && k >= 4 - padding;
            const std::uint8_t value = pad ? std::uint8_t{0} : digit_values[static_cast<unsigned char>(text[at + k])];
            if (value == not_a_letter) return std::nullopt;
            group = (group << 6) | value;
        }
        for (std::size_t k = 0; k < (last ? 3 - padding : 3); ++k) {
            bytes.push_back(static_cast<unsigned char>((group >> (16 - 8 * k)) & 255U));
        }
    }
    return bytes;
}

}  // namespace crackle
