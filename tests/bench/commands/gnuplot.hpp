// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures by gnuplot, a program of its own.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Runs gnuplot on a script, in the script's folder. @return empty if it drew, else what is wrong, one sentence
std::string draw_with_gnuplot(const std::filesystem::path& script);

}  // namespace crackle::tools
