// SPDX-License-Identifier: GPL-3.0-or-later
// Reads part of a stream in pieces, for data too large to be held in memory.
// Tested by tests/verification/determinism_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <istream>
#include <string_view>

namespace crackle {

/// Calls watch(piece) for consecutive pieces of the bytes from `begin` to `end`. @return whether all bytes could be
/// read; the stream is then at `end`
template <class Watch>
bool read_pieces(std::istream& in, std::streamoff begin, std::streamoff end, Watch watch) {
    std::array<char, 1 << 16> piece;
    in.seekg(begin);
    for (std::streamoff left = end - begin; left > 0;) {
        const auto wanted = static_cast<std::streamsize>(std::min<std::streamoff>(left, piece.size()));
        if (!in.read(piece.data(), wanted)) return false;
        watch(std::string_view(piece.data(), static_cast<std::size_t>(wanted)));
        left -= wanted;
    }
    return in.good();
}

/// Length of a stream in bytes. Resets the stream to its beginning.
inline std::streamoff length_of_stream(std::istream& in) {
    in.seekg(0, std::ios::end);
    const std::streamoff length = in.tellg();
    in.seekg(0);
    return length;
}

}  // namespace crackle
