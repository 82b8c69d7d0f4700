// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

/// Writes a whole file under a temporary name and renames it, so that a failure leaves the earlier one as it was.
/// @throws InputError if it cannot be written
void replace_file(const std::filesystem::path& path, const std::string& contents);

/// "cannot be written", with the system's reason in errno. @throws InputError
[[noreturn]] void refuse_output(const std::filesystem::path& path);

}  // namespace crackle
