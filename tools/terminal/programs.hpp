// SPDX-License-Identifier: GPL-3.0-or-later
// Where programs are: this one, those beside it, those on the PATH.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Folder of the running program's file; empty where the system does not tell.
std::filesystem::path own_folder();

/// Where a program is on the PATH; empty: nowhere.
std::string program_on_path(const std::string& name);

/// Where a program is: beside the running one, else on the PATH; empty: nowhere.
std::string program_beside_or_on_path(const std::string& name);

}  // namespace crackle::tools
