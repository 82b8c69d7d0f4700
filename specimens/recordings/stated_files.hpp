// SPDX-License-Identifier: GPL-3.0-or-later
// What a test's summary states of the files that it belongs to: their lengths and hashes (key `files`), by which files
// that were edited, cut or exchanged since are known.
// Tested by tests/specimens/results/stated_files_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/files/file_mark.hpp"
#include "specimens/recordings/test_summary.hpp"

namespace crackle {

/// Names in the test's folder.
using FileMarks = std::vector<std::pair<std::string, FileMark>>;

void state_files(TestSummary& summary, const FileMarks& files);

/// What a summary states; none where an earlier version wrote it, which stated nothing.
/// @param name of the summary, for the message @throws InputError if it is none that state_files() wrote
FileMarks stated_files(const TestSummary& summary, const std::string& name);

bool states(const FileMarks& stated, const std::string& name);

/// @param file in the summary's folder @param found what is in it now
/// @throws InputError if the summary states files, and not this one as it is
void require_as_stated(const FileMarks& stated, const std::filesystem::path& file, const FileMark& found);

}  // namespace crackle
