// SPDX-License-Identifier: GPL-3.0-or-later
// Marker for results that are being replaced. It is a file in OUT.new, the folder to which the new results are written.
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle {

inline constexpr const char* staging_suffix = ".new";
/// Name of the marker in OUT.new. It shows that the folder belongs to a test started with --force and may be discarded.
inline constexpr const char* staged_mark = "replaces-older-results";
/// First line of the marker once the results are complete and are being moved to OUT. The following lines are the names
/// of the frames.
inline constexpr const char* moving_line = "complete, being moved";

/// Whether the results in a folder are being moved. @param frames  receives the marker's lines after the first
bool is_being_moved(const std::filesystem::path& working, std::string& frames);

/// @throws InputError if a folder contains results of two tests, because replacing the earlier results was interrupted
void refuse_half_replaced(const std::filesystem::path& folder);

}  // namespace crackle
