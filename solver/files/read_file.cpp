// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/read_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"

namespace crackle {

std::string read_file(const std::filesystem::path& path) {
    std::error_code unknown;  // opening tells
    if (std::filesystem::is_directory(path, unknown))
        throw InputError(fmt::format("{}: found a folder, expected a file", path.string()));
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw InputError(fmt::format("{}: cannot be read ({}), expected a file", path.string(), std::strerror(errno)));
    // By read(): it alone says that the system gave an error, where `<< rdbuf()` takes that for the end.
    std::string bytes;
    std::array<char, 1 << 16> piece;
    do {
        file.read(piece.data(), piece.size());
        bytes.append(piece.data(), static_cast<std::size_t>(file.gcount()));
    } while (file);
    if (file.bad())
        throw InputError(fmt::format("{}: reading stopped with an error ({})", path.string(), std::strerror(errno)));
    return bytes;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    return text;
}

std::string read_text(const std::filesystem::path& path) {
    std::string text = read_file(path);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

}  // namespace crackle
