// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/report_test.cpp and tests/solver/files/file_set_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

/// Writes a whole file through a NewFile. If this fails, the existing file is unchanged; after a loss of power the file
/// has either its old or its new contents. On return the file has been flushed to the disc.
/// @throws OutputError, SystemFailure if it cannot be written, or if the path is a symbolic link
void replace_file(const std::filesystem::path& path, const std::string& contents);

/// Flushes the directory entries of a folder to the disc. @throws InputError if this fails
void bring_names_to_disc(const std::filesystem::path& folder);

/// Creates a folder and missing parent folders. @throws InputError if this fails
void make_folder(const std::filesystem::path& folder);

/// Flushes to the disc all data that has been written to the file system that contains a folder. @throws InputError if
/// this fails
void bring_all_to_disc(const std::filesystem::path& folder);

}  // namespace crackle
