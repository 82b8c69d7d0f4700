// SPDX-License-Identifier: GPL-3.0-or-later
// A program of commands, as `crackle` and `crackle-bench` are: a table of commands, --help and --version, and what a
// failure becomes: one message and an exit code.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <vector>

namespace crackle::tools {

struct CommandLine;
struct Invocation;

/// One command: a line for --help of its program, how it is called, and the function that runs it. The function prints
/// results to stdout and, by Messages, progress and notices to stderr; it returns the exit code and throws errors.
struct Command {
    const char* name;
    const char* summary;
    CommandLine (*describe)();
    int (*run)(const Invocation& given);
    const std::vector<Command>& (*studies)() = nullptr;  ///< named by the next word; else run() has it
};

struct Program {
    const char* name;        ///< as typed
    const char* summary;     ///< what it does, one line
    const char* first_word;  ///< what its first word names: "command"
    const std::vector<Command>& (*commands)();
};

// Exit codes of the programs; exit_codes() explains them.
inline constexpr int exit_done = 0;
inline constexpr int exit_claim_fails = 1;
inline constexpr int exit_bad_input = 2;      // InputError, wrong options
inline constexpr int exit_unstable = 3;       // UnstableRun
inline constexpr int exit_system_fails = 4;   // the output cannot be written, a library gives up
inline constexpr int exit_interrupted = 130;  // as a shell's own of SIGINT

struct ExitCode {
    int code;
    const char* meaning;
};
const std::vector<ExitCode>& exit_codes();

/// Runs what the words of main() ask for. @return exit code; an error is reported before
int run_program(const Program& program, int argc, char** argv);

}  // namespace crackle::tools
