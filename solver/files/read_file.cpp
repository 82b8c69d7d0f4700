// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/read_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"

namespace crackle {

namespace {

[[noreturn]] void refuse_unknown(const std::filesystem::path& path, const std::error_code& error) {
    throw InputError(fmt::format("{}: cannot be looked for ({})", path.string(), error.message()));
}

}  // namespace

void refuse_failed(const std::istream& in, const std::string& name) {
    if (in.bad()) throw InputError(fmt::format("{}: reading stopped with an error ({})", name, std::strerror(errno)));
}

bool is_there(const std::filesystem::path& path) {
    std::error_code error;
    const bool there = std::filesystem::exists(path, error);
    // A name too long for a file is none, nor is one below a file.
    if (error && error != std::errc::filename_too_long && error != std::errc::not_a_directory)
        refuse_unknown(path, error);
    return there;
}

bool is_file(const std::filesystem::path& path) {
    if (!is_there(path)) return false;
    std::error_code error;
    const bool file = std::filesystem::is_regular_file(path, error);
    if (error) refuse_unknown(path, error);
    return file;
}

bool is_folder(const std::filesystem::path& path) {
    if (!is_there(path)) return false;
    std::error_code error;
    const bool folder = std::filesystem::is_directory(path, error);
    if (error) refuse_unknown(path, error);
    return folder;
}

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
    refuse_failed(file, path.string());
    return bytes;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    return text;
}

namespace {

/// By its mark, or by the zeros in every other byte of its first two letters.
bool is_of_wide_letters(std::string_view bytes) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;
    if (bytes.size() < 4) return false;
    const auto zero = [&](std::size_t k) { return bytes[k] == '\0'; };
    return zero(0) == zero(2) && zero(1) == zero(3) && zero(0) != zero(1);
}

}  // namespace

void refuse_wide_letters(const std::filesystem::path& path, std::string_view bytes) {
    if (is_of_wide_letters(bytes)) {
        throw InputError(
            fmt::format("{}: found UTF-16, expected UTF-8 or ASCII; save the text as UTF-8", path.string()));
    }
}

std::string read_text(const std::filesystem::path& path) {
    std::string text = read_file(path);
    refuse_wide_letters(path, text);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

}  // namespace crackle
