// SPDX-License-Identifier: GPL-3.0-or-later
// Finds shipped cases and decks (specimens/...), whatever the current folder and the installation folder are.
// Tested by tests/tools/terminal/shipped_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Folder that contains specimens/: for an installed program ../share/crackle, otherwise the source folder from which
/// it was built. Empty if there is none.
std::filesystem::path shipped_folder();

/// The shipped file if `path` does not exist but begins with specimens/; otherwise `path` itself.
std::filesystem::path given_or_shipped(const std::string& path);

}  // namespace crackle::tools
