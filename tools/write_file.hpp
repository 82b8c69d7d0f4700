// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// @throws InputError if the file cannot be written
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace crackle::tools
