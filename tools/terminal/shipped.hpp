// SPDX-License-Identifier: GPL-3.0-or-later
// Shipped cases and decks (specimens/...), found from wherever the program is called and wherever it was moved to.
// Tested by tests/tools/terminal/shipped_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Folder that holds specimens/: beside an installed program (../share/crackle), or the sources that it was built in;
/// empty where there is none.
std::filesystem::path shipped_folder();

/// A path as given if it exists; else, of one that begins with specimens/, the shipped one; else as given.
std::filesystem::path given_or_shipped(const std::string& path);

}  // namespace crackle::tools
