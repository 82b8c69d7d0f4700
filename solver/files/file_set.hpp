// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a folder that belong together, replaced all or none: whoever is stopped at any moment, by a signal, a full
// disc or a loss of power, leaves the earlier set or the new one, never a mixture.
//
// The whole new set is first written as one file, the journal; from the moment it has its name the replacement counts
// as done, and whoever reads the set next ends what is left of it. Files too large for that are written beforehand
// under other names, and the journal says what each is renamed to.
// Tested by tests/solver/files/file_set_test.cpp and tests/solver/demseg/replaced_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace crackle {

/// Names in one folder, with contents.
using FileSet = std::vector<std::pair<std::string, std::string>>;
/// Names of complete files in that folder, with the names that they get.
using Renames = std::vector<std::pair<std::string, std::string>>;

/// The first half of a replacement: from here it comes to its end, whoever is stopped.
/// @param journal its path; the files lie beside it
/// @param renames of files that are on the disc, contents and names
/// @throws InputError if something cannot be written
void write_journal(const std::filesystem::path& journal, const FileSet& files, const Renames& renames = {});

/// Whether a journal is there that renames files. @throws InputError if it is damaged
bool renames_files(const std::filesystem::path& journal);

/// The other half, or what is left of it. @return whether there was a journal
/// @throws InputError if it is damaged, or something cannot be written
bool complete_replacement(const std::filesystem::path& journal);

}  // namespace crackle
