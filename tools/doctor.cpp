// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle doctor` and `crackle --version`: what this build is made of and what it can do.

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <string>
#include <thread>

#include "solver/errors.hpp"
#include "tools/build_info.hpp"
#include "tools/commands.hpp"
#include "tools/page_template.hpp"

namespace crackle::tools {
namespace {

namespace po = boost::program_options;

constexpr const char* doctor_examples = R"(
examples:
  crackle doctor
)";

/// Instruction sets beyond the compiler's default that the code was compiled for; another processor may lack them.
std::string vector_instructions() {
    std::string sets;
#ifdef __AVX2__
    sets += " AVX2";
#endif
#ifdef __FMA__
    sets += " FMA";
#endif
#ifdef __AVX512F__
    sets += " AVX-512F";
#endif
#ifdef __ARM_FEATURE_SVE
    sets += " SVE";
#endif
    return sets.empty() ? " the processor family's baseline, runs on all of them"
                        : sets + ", those of the building machine";
}

void line(const char* what, const std::string& text) { fmt::print("{:<14}{}\n", what, text); }

}  // namespace

int version(const Arguments&) {
    fmt::print("crackle {}\n", build_info::version);
    return exit_done;
}

int doctor(const Arguments& arguments) {
    po::options_description options("options");
    options.add_options()("help,h", "show this");
    po::variables_map given;
    po::store(po::command_line_parser(arguments).options(options).positional({}).run(), given);
    po::notify(given);
    if (given.contains("help")) {
        std::cout << "usage: crackle doctor\n\nWhat this build is made of and what it can do.\n\n"
                  << options << doctor_examples;
        return exit_done;
    }
    line("crackle", build_info::version);
    line("build", fmt::format("{}, {}", build_info::build_type, build_info::compiler));
    line("flags", build_info::flags);
    line("instructions", vector_instructions().substr(1));
    line("sanitizers", build_info::sanitizers ? "address and undefined behaviour: slow, for tests" : "none");
    line("threads", fmt::format("{} on this machine; OpenMP {}; results are the same for any number",
                                std::thread::hardware_concurrency(), _OPENMP));
    for (const build_info::Library& library : build_info::libraries) {
        line("library", fmt::format("{} {}: {}", library.name, library.version, library.serves));
    }
    line("report page", page_template().empty()
                            ? "absent: `crackle report` needs a build with -DCRACKLE_VIEWER=ON"
                            : fmt::format("embedded, {} KiB: `crackle report` works without a network",
                                          page_template().size() / 1024));
    return exit_done;
}

}  // namespace crackle::tools
