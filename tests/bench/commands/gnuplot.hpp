// SPDX-License-Identifier: GPL-3.0-or-later
// Draws pictures with gnuplot, which runs as a separate program.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <filesystem>
#include <string>

namespace crackle::tools {

/// Runs gnuplot on a script, in the script's folder. @return empty on success, otherwise one sentence about the error
std::string draw_with_gnuplot(const std::filesystem::path& script);

}  // namespace crackle::tools
