// SPDX-License-Identifier: GPL-3.0-or-later
// Reads sizes and pixels of PNG files, for tests of figures.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace crackle::testing {

/// Width or height of a PNG, from its header.
inline std::uint32_t png_number(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t k = at; k < at + 4; ++k) number = 256 * number + static_cast<unsigned char>(bytes.at(k));
    return number;
}

/// The pixels of an RGB PNG, row by row.
inline std::vector<std::vector<unsigned char>> png_rows(const std::string& bytes) {
    const std::size_t width = png_number(bytes, 16), height = png_number(bytes, 20), row = 3 * width;
    EXPECT_EQ(bytes.at(25), 2) << "expected red, green, blue";
    std::string packed;
    for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + png_number(bytes, at)) {
        if (bytes.substr(at + 4, 4) == "IDAT") packed += bytes.substr(at + 8, png_number(bytes, at));
    }
    std::vector<unsigned char> raw((row + 1) * height);
    auto size = static_cast<uLongf>(raw.size());
    EXPECT_EQ(uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()), Z_OK);
    std::vector<std::vector<unsigned char>> rows;
    std::vector<unsigned char> above(row);
    for (std::size_t y = 0; y < height; ++y) {
        const unsigned char* line = raw.data() + y * (row + 1);
        std::vector<unsigned char> now(row);
        for (std::size_t x = 0; x < row; ++x) {
            const int left = x < 3 ? 0 : now[x - 3], up = above[x], corner = x < 3 ? 0 : above[x - 3];
            const int guess = left + up - corner, a = std::abs(guess - left), b = std::abs(guess - up),
                      c = std::abs(guess - corner);
            const std::array<int, 5> filters{0, left, up, (left + up) / 2,
                                             a <= b && a <= c ? left : (b <= c ? up : corner)};
            now[x] = static_cast<unsigned char>(line[1 + x] + filters.at(line[0]));
        }
        rows.push_back(now);
        above = now;
    }
    return rows;
}

}  // namespace crackle::testing
