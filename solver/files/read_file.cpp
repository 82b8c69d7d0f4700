// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/read_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"

namespace crackle {

namespace {

[[noreturn]] void refuse_longer(const std::filesystem::path& path, std::uint64_t most_bytes) {
    throw InputError(fmt::format(
        "{0}: found more than {1} bytes, expected at most {1}, the limit for such files; use a smaller file",
        path.string(), most_bytes));
}

[[noreturn]] void refuse_unknown(const std::filesystem::path& path, const std::error_code& error) {
    fail_reading(error.value(),
                 fmt::format("{}: its existence cannot be checked ({})", path.string(), error.message()));
}

}  // namespace

void refuse_failed(const std::istream& in, const std::string& name) {
    if (in.bad())
        fail_reading(errno, fmt::format("{}: reading stopped with an error ({})", name, std::strerror(errno)));
}

bool is_there(const std::filesystem::path& path) {
    std::error_code error;
    const bool there = std::filesystem::exists(path, error);
    // These two errors mean that the path does not exist.
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

std::set<std::string> names_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory) return names;
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
        names.insert(entry->path().filename().string());
    if (error) fail_reading(error.value(), fmt::format("{}: cannot be listed ({})", folder.string(), error.message()));
    return names;
}

std::string read_file(const std::filesystem::path& path, std::uint64_t most_bytes) {
    std::error_code unknown;  // ignored, because opening the file reports the error
    if (std::filesystem::is_directory(path, unknown))
        throw InputError(fmt::format("{}: found a folder, expected a file", path.string()));
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    // Files of unknown size are checked while they are read.
    if (!unknown && size > most_bytes) refuse_longer(path, most_bytes);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        fail_reading(errno,
                     fmt::format("{}: cannot be read ({}), expected a file", path.string(), std::strerror(errno)));
    // read() is used because it reports system errors; `<< rdbuf()` would treat them as the end of the file.
    std::string bytes;
    std::array<char, 1 << 16> piece;
    do {
        file.read(piece.data(), piece.size());
        bytes.append(piece.data(), static_cast<std::size_t>(file.gcount()));
        if (bytes.size() > most_bytes) refuse_longer(path, most_bytes);
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

/// Whether a text is UTF-16. It is recognised by its byte order mark, or by a zero in one byte of each of its first two
/// characters.
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

std::string read_text(const std::filesystem::path& path, std::uint64_t most_bytes) {
    std::string text = read_file(path, most_bytes);
    refuse_wide_letters(path, text);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

}  // namespace crackle
