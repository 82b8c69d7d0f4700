// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/report_test.cpp and tests/solver/files/file_set_test.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace crackle {

/// Writes a whole file under a temporary name and renames it. A failure leaves the earlier one as it was, a loss of
/// power that or this; when this returns it is on the disc.
/// @throws OutputError if it cannot be written
void replace_file(const std::filesystem::path& path, const std::string& contents);

/// Has the system bring the names in a folder to the disc. @throws InputError if it cannot
void bring_names_to_disc(const std::filesystem::path& folder);

/// For a file that the user names to be written. @param inputs what the command reads: never replaced
/// @throws InputError if it is one of these, or is there already without `force`
void refuse_replacing(const std::filesystem::path& output, bool force,
                      std::span<const std::filesystem::path> inputs = {});

/// Makes a folder and those it lies in, where they are missing. @throws InputError if it cannot
void make_folder(const std::filesystem::path& folder);

/// Has the system bring all that was written to the file system of a folder to the disc. @throws InputError if it
/// cannot
void bring_all_to_disc(const std::filesystem::path& folder);

/// "cannot be written", with the system's reason in errno. @throws OutputError
[[noreturn]] void refuse_output(const std::filesystem::path& path);

}  // namespace crackle
