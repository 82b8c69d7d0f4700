// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <filesystem>

namespace crackle::tools {

/// Makes the folder of a study's results where there is none. @throws InputError if it cannot
void make_results_folder(const std::filesystem::path& folder);

}  // namespace crackle::tools
