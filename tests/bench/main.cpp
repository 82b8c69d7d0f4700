// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program `crackle-bench`.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <exception>

#include "tests/bench/commands/bench.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/command_line/program.hpp"

int main(int argc, char** argv) {
    using namespace crackle::tools;
    const Program program{.name = "crackle-bench",
                          .summary = "studies of crackle's engine, each of which can write its page",
                          .first_word = "study",
                          .commands = bench_studies};
    try {
        const SelectedCommand command = select_command(program, argc, argv);
        return end_output(command.run == nullptr ? command.code : command.run(*command.given));
    } catch (const std::exception&) {
        return report_failure(argc > 1 ? argv[1] : program.name);
    }
}
