// SPDX-License-Identifier: GPL-3.0-or-later
// The folder that a deck run leaves its files in: which they are, and what of an earlier run is there.
//
// The files with which a run goes on are replaced together (file_set.hpp). Where a run takes the place of an earlier
// one, its outputs, too, are written under other names and get their own with its first such replacement: until then
// all that the earlier run left is there as it was.
// Tested by tests/solver/demseg/replaced_test.cpp.
#pragma once

#include <filesystem>
#include <optional>

namespace crackle {

inline constexpr const char* state_name = "new_state.bin";

/// Of the replacement of a folder's files.
std::filesystem::path deck_journal(const std::filesystem::path& folder);

/// Ends a replacement that was stopped. @return whether there was one
/// @throws InputError if another process holds the folder, or something cannot be written
bool complete_deck_replacement(const std::filesystem::path& folder);

/// An output or text file for the next part that an earlier run left; new_state.bin may be there as an input, as
/// DEMseg's users rename the text files alone.
std::optional<std::filesystem::path> earlier_output(const std::filesystem::path& folder);

/// Removes the files of a run that was stopped before they got their names. @throws InputError
void remove_staged_files(const std::filesystem::path& folder);

}  // namespace crackle
