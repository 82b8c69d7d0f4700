// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/files/read_file_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

/// The bytes of a file, all of them.
/// @throws InputError if it is none, cannot be opened, or reading stops before its end
std::string read_file(const std::filesystem::path& path);

}  // namespace crackle
