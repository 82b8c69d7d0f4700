// SPDX-License-Identifier: GPL-3.0-or-later
// Checks output paths given by the user before any work is done. Tested by tests/solver/files/output_path_test.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace crackle {

/// Checks the name of an output file, which may replace an existing file. Removes temporary files that interrupted runs
/// have left in its folder.
/// @throws InputError if the name is empty, or is that of a folder, a link or a device
std::filesystem::path output_file(const std::filesystem::path& named);

/// Like output_file(named), with further checks. @param force whether an existing file may be replaced @param inputs
/// files that the command reads, which are never replaced
/// @throws InputError if the file is one of the inputs, or exists and `force` is false
std::filesystem::path output_file(const std::filesystem::path& named, bool force,
                                  std::span<const std::filesystem::path> inputs = {});

/// Folder of a file; the current folder if the path has none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Checks the name of an output folder. The result has no trailing slash and no "." or "..", so that a sibling folder's
/// path can be formed from it. @throws InputError if the name is empty or is that of a file
std::filesystem::path output_folder(const std::filesystem::path& named);

/// Refuses a folder that contains files, but none of those that the command would write. Temporary files of interrupted
/// runs are ignored.
/// @param expected what the folder should contain @throws InputError «folder: found X, expected ...»
void refuse_foreign_files(const std::filesystem::path& folder, const std::string& expected);

/// Refuses a folder that contains an input file: such a folder is the user's own and not meant for results. @throws
/// InputError if one of the inputs is in the folder or below it
void refuse_folder_of_inputs(const std::filesystem::path& folder, std::span<const std::filesystem::path> inputs);

}  // namespace crackle
