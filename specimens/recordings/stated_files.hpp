// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths and hashes of a test's files, stored in its summary (key `files`). They reveal files that were edited,
// truncated or exchanged later.
// Tested by tests/specimens/results/stated_files_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/files/file_mark.hpp"
#include "specimens/summary/summary.hpp"

namespace crackle {

/// Names of files in the test's folder, with length and hash.
using FileMarks = std::vector<std::pair<std::string, FileMark>>;

/// Puts names, lengths and hashes of files into a summary.
void state_files(Summary& summary, const FileMarks& files);

/// The files recorded in a summary; empty for summaries of earlier versions, which recorded no files.
/// @param name  file name of the summary, for messages
/// @throws InputError if the entry does not have the format of state_files()
FileMarks stated_files(const Summary& summary, const std::string& name);

/// Whether a summary records a file. @param name  name of the file in the test's folder
bool states(const FileMarks& stated, const std::string& name);

/// Checks a file against the summary.
/// @param file  file in the summary's folder
/// @param found  current length and hash of the file
/// @throws InputError if the summary records files, but not this one with the same length and hash
void require_as_stated(const FileMarks& stated, const std::filesystem::path& file, const FileMark& found);

}  // namespace crackle
