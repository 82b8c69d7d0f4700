// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program `crackle`.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <exception>

#include "tools/command_line/command_line.hpp"
#include "tools/command_line/program.hpp"
#include "tools/commands/commands.hpp"

int main(int argc, char** argv) {
    using namespace crackle::tools;
    const Program program{.name = "crackle",
                          .summary = "makes bonded rock specimens and tests them",
                          .first_word = "command",
                          .commands = commands};
    try {
        const SelectedCommand command = select_command(program, argc, argv);
        return end_output(command.run == nullptr ? command.code : command.run(*command.given));
    } catch (const std::exception&) {
        return report_failure(argc > 1 ? argv[1] : program.name);
    }
}
