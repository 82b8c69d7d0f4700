// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program `crackle-bench`.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include "tests/bench/commands/bench.hpp"
#include "tools/command_line/program.hpp"

int main(int argc, char** argv) {
    using namespace crackle::tools;
    const Program program{.name = "crackle-bench",
                          .summary = "studies of crackle's engine, each of which can write its page",
                          .first_word = "study",
                          .commands = bench_studies};
    return run_program(program, argc, argv);
}
