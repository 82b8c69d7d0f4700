// SPDX-License-Identifier: GPL-3.0-or-later
// The output folder of a deck run: its files, and files left there by an earlier run.
//
// The files from which a run can be resumed are replaced as a set (file_set.hpp). If a run replaces an earlier one, its
// outputs are first written under temporary names. They receive their final names together with the first such set;
// until then the files of the earlier run are unchanged.
// Tested by tests/solver/demseg/replaced_test.cpp.
#pragma once

#include <filesystem>
#include <optional>

namespace crackle {

inline constexpr const char* state_name = "new_state.bin";

/// Path of the journal used to replace files in a folder.
std::filesystem::path deck_journal(const std::filesystem::path& folder);

/// Completes an interrupted replacement. @return whether there was one
/// @throws InputError if another process has locked the folder, or a file cannot be written
bool complete_deck_replacement(const std::filesystem::path& folder);

/// An output file that an earlier run has left in the folder, or one of its text files for the next part. new_state.bin
/// is not considered, since it may be an input: users of DEMseg rename only the text files.
std::optional<std::filesystem::path> earlier_output(const std::filesystem::path& folder);

/// Removes files of an interrupted run that have not received their final names. @throws InputError
void remove_staged_files(const std::filesystem::path& folder);

}  // namespace crackle
