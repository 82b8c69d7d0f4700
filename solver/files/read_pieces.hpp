// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a stream piece by piece, for what must not be in the memory as a whole.
// Tested by tests/verification/determinism_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <istream>
#include <string_view>

namespace crackle {

/// Bytes from `begin` on up to `end` to watch(piece). @return whether all could be read; the stream stands at `end`
/// then
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

/// Its length, bytes; the stream stands at its begin.
inline std::streamoff length_of_stream(std::istream& in) {
    in.seekg(0, std::ios::end);
    const std::streamoff length = in.tellg();
    in.seekg(0);
    return length;
}

}  // namespace crackle
