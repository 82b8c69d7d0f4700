// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/files/read_file_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <set>
#include <string>
#include <string_view>

namespace crackle {

// Size limits of files that are read as a whole, by type of contents.
inline constexpr std::uint64_t most_bytes_of_keys = std::uint64_t{1} << 24;       // TOML: 16 MiB
inline constexpr std::uint64_t most_bytes_of_table = std::uint64_t{1} << 30;      // 1 GiB
inline constexpr std::uint64_t most_bytes_of_particles = std::uint64_t{1} << 34;  // decks and results: 16 GiB

/// Reads all bytes of a file.
/// @throws InputError if it is not a plain file, cannot be read completely, or has more bytes than the limit
std::string read_file(const std::filesystem::path& path,
                      std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max());

/// The text without the byte order mark (UTF-8) that some editors add at its beginning.
std::string_view without_byte_order_mark(std::string_view text);

/// Refuses a file in UTF-16. @throws InputError
void refuse_wide_letters(const std::filesystem::path& path, std::string_view bytes);

/// Reads a text file, without its byte order mark. @throws InputError under the same conditions as read_file(), and if
/// the text is UTF-16, with a message that says so
std::string read_text(const std::filesystem::path& path, std::uint64_t most_bytes = most_bytes_of_particles);

/// Checks that reading from a stream stopped at the end of the data. @throws InputError if it stopped because of a
/// system error
void refuse_failed(const std::istream& in, const std::string& name);

/// Whether a path exists. @throws InputError, SystemFailure if the operating system cannot determine it
bool is_there(const std::filesystem::path& path);
/// Whether a path leads to a plain file, not to a folder or device. @throws InputError, SystemFailure if the operating
/// system cannot determine it
bool is_file(const std::filesystem::path& path);
/// Whether a path leads to a folder. @throws InputError, SystemFailure if the operating system cannot determine it
bool is_folder(const std::filesystem::path& path);
/// Names in a folder; empty if there is no such folder. @throws InputError, SystemFailure if it cannot be listed
std::set<std::string> names_in(const std::filesystem::path& folder);

}  // namespace crackle
