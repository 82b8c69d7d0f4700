// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces a set of files in a folder as a unit. A signal, a full disc or a loss of power may stop the process at any
// time; afterwards either the old set or the new one exists, never a mixture.
//
// The new files are first written under temporary names and flushed to the disc. Then a journal that lists their final
// names is written. Once the journal exists, the replacement counts as done: if the process is stopped, the next reader
// of the set completes it.
// Tested by tests/solver/files/file_set_test.cpp and tests/solver/demseg/replaced_test.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace crackle {

/// Names of files in one folder, with their contents.
using FileSet = std::vector<std::pair<std::string, std::string>>;
/// Pairs of temporary and final names of completely written files in the folder.
using Renames = std::vector<std::pair<std::string, std::string>>;

/// Suffix of a file that receives its final name together with the other files of its set.
inline constexpr const char* staged_suffix = ".new";

/// First half of a replacement: writes the files under temporary names, and then the journal. After a successful
/// return, the replacement will be completed even if the process is stopped. On failure, the files written are removed,
/// unless the journal exists. All other data written to this file system are flushed as well.
/// @param journal path of the journal, in the folder of the files
/// @param renames further files of the set that are already written
/// @throws OutputError if a file cannot be written
void write_journal(const std::filesystem::path& journal, const FileSet& files, const Renames& renames = {});

/// Whether a journal exists that lists one of the given names as a final name. @throws InputError if it is damaged
bool gives_name(const std::filesystem::path& journal, std::span<const char* const> names);

/// Second half of a replacement: renames the files that still have temporary names, and removes the journal. @return
/// whether there was a journal
/// @throws InputError if the journal is damaged, OutputError if a file cannot be written
bool complete_replacement(const std::filesystem::path& journal);

}  // namespace crackle
