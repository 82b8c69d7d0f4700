// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a folder that belong together, replaced all or none: whoever is stopped at any moment, by a signal, a full
// disc or a loss of power, leaves the earlier set or the new one, never a mixture.
//
// The new files are first written under other names and brought to the disc. Then a journal says what each is renamed
// to; from the moment it has its name the replacement counts as done, and whoever reads the set next ends what is left.
// Tested by tests/solver/files/file_set_test.cpp and tests/solver/demseg/replaced_test.cpp.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace crackle {

/// Names in one folder, with contents.
using FileSet = std::vector<std::pair<std::string, std::string>>;
/// Names of complete files in that folder, with the names that they get.
using Renames = std::vector<std::pair<std::string, std::string>>;

/// Behind the name of a file that gets its own with the set that it belongs to.
inline constexpr const char* staged_suffix = ".new";

/// The first half of a replacement: from here it comes to its end, whoever is stopped. Where it fails, the files that
/// it wrote are removed again unless the journal stands. All else that was written to this file system is on the disc,
/// too.
/// @param journal its path; the files lie beside it
/// @param renames of files that are written already
/// @throws OutputError if something cannot be written
void write_journal(const std::filesystem::path& journal, const FileSet& files, const Renames& renames = {});

/// Whether a journal is there that gives a file one of these names. @throws InputError if it is damaged
bool gives_name(const std::filesystem::path& journal, std::span<const char* const> names);

/// The other half, or what is left of it. @return whether there was a journal
/// @throws InputError if it is damaged, OutputError if something cannot be written
bool complete_replacement(const std::filesystem::path& journal);

}  // namespace crackle
