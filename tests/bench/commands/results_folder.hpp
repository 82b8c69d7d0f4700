// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <filesystem>

namespace crackle::tools {

/// Creates the folder for a study's results if it is missing. @throws InputError if this fails
void make_results_folder(const std::filesystem::path& folder);

}  // namespace crackle::tools
