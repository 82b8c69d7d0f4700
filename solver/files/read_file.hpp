// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/files/read_file_test.cpp.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

namespace crackle {

/// The bytes of a file, all of them.
/// @throws InputError if it is none, cannot be opened, or reading stops before its end
std::string read_file(const std::filesystem::path& path);

/// A text without the byte order mark (UTF-8) that some editors put in front.
std::string_view without_byte_order_mark(std::string_view text);

/// @throws InputError if the bytes of a file are UTF-16
void refuse_wide_letters(const std::filesystem::path& path, std::string_view bytes);

/// A file of text: its bytes without such a mark. @throws InputError as read_file(), and for UTF-16, which is named
std::string read_text(const std::filesystem::path& path);

/// @throws InputError if the system gave an error while a stream was read, which is no end of it
void refuse_failed(const std::istream& in, const std::string& name);

/// Whether a path is there; a file; a folder. @throws InputError if the system does not say: that is no "no"
bool is_there(const std::filesystem::path& path);
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

}  // namespace crackle
