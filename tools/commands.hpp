// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `crackle`, one file each. A command reads its own arguments, prints to stdout (results) and stderr
// (progress, notices), and returns the exit code; errors are thrown and turned into messages by main().
#pragma once

#include <string>
#include <vector>

namespace crackle::tools {

using Arguments = std::vector<std::string>;

/// One subcommand: name, a line for `crackle --help`, and the function that runs it with the words after its name.
struct Command {
    const char* name;
    const char* summary;
    int (*run)(const Arguments& arguments);
};

int pack(const Arguments& arguments);
int mesh(const Arguments& arguments);
int run_deck(const Arguments& arguments);
int test(const Arguments& arguments);
int elastic(const Arguments& arguments);
int report(const Arguments& arguments);
int bench(const Arguments& arguments);
int doctor(const Arguments& arguments);
int version(const Arguments& arguments);  // crackle --version

// Exit codes of the program.
inline constexpr int exit_done = 0;
inline constexpr int exit_claim_fails = 1;    // crackle bench verify: a row does not hold
inline constexpr int exit_bad_input = 2;      // InputError, wrong options
inline constexpr int exit_unstable = 3;       // UnstableRun; outputs up to there are kept
inline constexpr int exit_interrupted = 130;  // Ctrl-C; outputs up to there are kept

}  // namespace crackle::tools
