// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle bench STUDY`: starts crackle-bench, which is a separate program and package.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "solver/base/errors.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/programs.hpp"

namespace crackle::tools {
namespace {

constexpr const char* bench_name = "crackle-bench";

}  // namespace

std::string bench_program() { return program_beside_or_on_path(bench_name); }

CommandLine describe_bench() {
    return {
        .synopses = {"crackle bench STUDY [OPTIONS]   (crackle-bench --help lists the studies)"},
        .description =
            "Starts crackle-bench with the same arguments. It contains studies of the engine, each of which can write "
            "a page of results. It is a separate program, searched for in the same folder as crackle and on the PATH.",
        .takes_options = false,
        .examples = {{"crackle bench accuracy --quick -o out/accuracy", "run time against error"},
                     {"crackle bench stress --steps 1000", "numerical stability"}}};
}

int bench(const Invocation& given) {
    const std::string program = bench_program();
    if (program.empty()) {
        throw InputError(
            "crackle bench: found no crackle-bench, expected this program in the same folder as crackle or on the "
            "PATH; install the Debian package crackle-bench, or build it from the sources: cmake --build --preset "
            "release --target crackle-bench");
    }
    Arguments words = given.words;
    words.insert(words.begin(), bench_name);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(program.c_str(), pointers.data());
    throw std::system_error(errno, std::generic_category(), program);
}

}  // namespace crackle::tools
