// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program `crackle`.
// Tested by tests/tools/commands/command_line_test.cpp.

#include "tools/command_line/program.hpp"
#include "tools/commands/commands.hpp"

int main(int argc, char** argv) {
    using namespace crackle::tools;
    const Program program{.name = "crackle",
                          .summary = "makes bonded rock specimens and tests them",
                          .first_word = "command",
                          .commands = commands};
    return run_program(program, argc, argv);
}
