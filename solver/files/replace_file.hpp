// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/report_test.cpp and tests/solver/files/file_set_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

enum class Durable : bool { no, yes };

/// Writes a whole file under a temporary name and renames it, so that a failure leaves the earlier one as it was.
/// @param durable on the disc when this returns: a loss of power leaves the earlier one or this
/// @throws InputError if it cannot be written
void replace_file(const std::filesystem::path& path, const std::string& contents, Durable durable = Durable::no);

/// Has the system bring the names in a folder to the disc. @throws InputError if it cannot
void bring_names_to_disc(const std::filesystem::path& folder);

/// "cannot be written", with the system's reason in errno. @throws InputError
[[noreturn]] void refuse_output(const std::filesystem::path& path);

}  // namespace crackle
