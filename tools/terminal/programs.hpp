// SPDX-License-Identifier: GPL-3.0-or-later
// Finds programs: the running one, those in its folder, and those on the PATH.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Folder of the running program; empty if the system cannot report it.
std::filesystem::path own_folder();

/// Path of a program on the PATH; empty if it is not found.
std::string program_on_path(const std::string& name);

/// Path of a program in the folder of the running one, or otherwise on the PATH; empty if it is not found.
std::string program_beside_or_on_path(const std::string& name);

}  // namespace crackle::tools
