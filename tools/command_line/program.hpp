// SPDX-License-Identifier: GPL-3.0-or-later
// A program with subcommands, such as `crackle` and `crackle-bench`: table of commands, --help and --version. It
// reports a failure by one message and an exit code.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <memory>
#include <vector>

namespace crackle::tools {

struct CommandLine;
struct Invocation;
class Messages;

/// One command: its line in the program's --help, its command line, and the function that runs it. The function prints
/// results to stdout, and uses Messages for progress and notices on stderr. It returns the exit code, or throws an
/// error.
struct Command {
    const char* name;
    const char* summary;
    CommandLine (*describe)();
    int (*run)(const Invocation& given);
    /// Table of subcommands; run() is called if the next word names none of them. Null if there are no subcommands.
    const std::vector<Command>& (*studies)() = nullptr;
};

struct Program {
    const char* name;        ///< name as typed by the user
    const char* summary;     ///< description in one line
    const char* first_word;  ///< what messages call the first word, for example "command"
    const std::vector<Command>& (*commands)();
};

// Exit codes of the programs; exit_codes() returns their meanings.
inline constexpr int exit_done = 0;
inline constexpr int exit_claim_fails = 1;
inline constexpr int exit_bad_input = 2;  // InputError, invalid options
inline constexpr int exit_unstable = 3;   // UnstableRun
// SystemFailure, lack of memory, an error while writing to stdout, or a failure in a library
inline constexpr int exit_system_fails = 4;
inline constexpr int exit_interrupted = 130;  // usual shell exit code for SIGINT

struct ExitCode {
    int code;
    const char* meaning;
};
const std::vector<ExitCode>& exit_codes();

/// The command selected by a command line. If no command is selected, for example with --help, the requested text has
/// already been printed.
struct SelectedCommand {
    SelectedCommand();
    SelectedCommand(SelectedCommand&& other) noexcept;
    ~SelectedCommand();

    int (*run)(const Invocation& given) = nullptr;  ///< null if there is nothing to run
    int code = exit_done;                           ///< exit code if there is nothing to run
    std::unique_ptr<Messages> messages;
    std::unique_ptr<Invocation> given;
};

// A program's main() calls the three functions below and, between them, the command itself. The command thus runs
// directly below main() on the call stack.

/// Prepares the process and selects a command. @throws InputError, SystemFailure
SelectedCommand select_command(const Program& program, int argc, char** argv);
/// Writes pending output to stdout after a command. @return `code`, or exit_system_fails if it was 0 and writing failed
int end_output(int code);
/// Reports the exception that is being handled. @param called  name of the command in messages @return exit code
int report_failure(const char* called);

}  // namespace crackle::tools
