// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle doctor`: prints the components and capabilities of this build, and what is missing.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <fmt/format.h>
#include <isa-l.h>
#include <xxhash.h>

#include <Spectra/Util/Version.h>
#include <cereal/version.hpp>
#include <string>
#include <thread>
#include <vector>

#include "solver/base/instruction_set.hpp"
#include "solver/machine/processors_lent.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/build_info.hpp"
#include "tools/commands/commands.hpp"
#include "tools/page/page_template.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/programs.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

/// Instruction sets as text, such as "x86-64-v3, chosen from x86-64-v2, x86-64-v3, x86-64-v4; ...".
std::string instructions() {
    std::string built_in;
    for (const InstructionSet set : built_in_sets())
        built_in += fmt::format("{}{}", built_in.empty() ? "" : ", ", name_of(set));
    return fmt::format("{}, chosen from {}; CRACKLE_ISA selects another; results are the same with each",
                       name_of(chosen_set()), built_in);
}

void line(const char* what, const std::string& text) { print_out("{:<14}{}\n", what, text); }

/// Missing components that would be useful, and how to get them.
std::vector<std::string> missing_parts(bool page, bool gnuplot_for_bench) {
    std::vector<std::string> missing;
    if (!page) {
        missing.emplace_back(
            "the report page: configure with -DCRACKLE_VIEWER=ON; this needs Node 18 or later, and npm");
    }
    if (!gnuplot_for_bench)
        missing.emplace_back("gnuplot: apt-get install gnuplot-nox; crackle-bench draws pictures with it");
    if (build_info::sanitizers)
        missing.emplace_back("full speed: this build is slow because it has sanitizers; build the preset `release`");
    if (std::string(build_info::build_type) != "Release" && !build_info::sanitizers)
        missing.emplace_back("full speed: this build is not optimised; build the preset `release`");
    return missing;
}

}  // namespace

CommandLine describe_doctor() {
    return {
        .synopses = {"crackle doctor"},
        .description = "Prints the components and capabilities of this build, and what is missing and how to get it.",
        .verbose = "the compiler flags of this build",
        .examples = {{"crackle doctor"}}};
}

int doctor(const Invocation& given) {
    const std::size_t page = page_template().size();
    const std::string studies = bench_program(), gnuplot = program_on_path("gnuplot");
    line("crackle", build_info::version);
    line("build", fmt::format("{}, {}", build_info::build_type, build_info::compiler));
    if (given.messages.verbose()) line("flags", build_info::flags);
    line("instructions", instructions());
    line("lanes", fmt::format("{} doubles side by side in the contact kernels", lanes_of(chosen_set())));
    line("sanitizers", build_info::sanitizers ? "address and undefined behaviour: slow, for tests" : "none");
    line("threads",
         fmt::format("{} of {} processors of this machine may be used; OpenMP {}; results are the same for any number",
                     processors_lent(), std::thread::hardware_concurrency(), _OPENMP));
    for (const build_info::Library& library : build_info::libraries) {
        line("library", fmt::format("{} {}: {}", library.name, library.version, library.serves));
    }
    // Libraries whose versions are stated only in their headers.
    line("library", fmt::format("Spectra {}.{}.{}: vibration modes", SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION,
                                SPECTRA_PATCH_VERSION));
    line("library",
         fmt::format("cereal {}.{}.{}: checkpoints", CEREAL_VERSION_MAJOR, CEREAL_VERSION_MINOR, CEREAL_VERSION_PATCH));
    line("library",
         fmt::format("xxHash {}.{}.{}: hash of a state", XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE));
    line("library",
         fmt::format("ISA-L {}.{}.{}: frames written", ISAL_MAJOR_VERSION, ISAL_MINOR_VERSION, ISAL_PATCH_VERSION));
    line("report page", page == 0
                            ? "absent: `crackle report` and `crackle view` cannot write pages"
                            : fmt::format("embedded, {} KiB: `crackle report` works without a network", page / 1024));
    const std::string shipped = shipped_folder();
    line("shipped", shipped.empty() ? "found no cases: `crackle test specimens/...` needs the path of an existing case"
                                    : "specimens/... is also looked for in " + shipped);
    line("crackle-bench",
         studies.empty() ? "not found: `crackle bench` prints where to get it" : studies + ": studies of the engine");
    line("gnuplot",
         gnuplot.empty()
             ? "not found on the PATH: without it, `crackle-bench` writes tables and gnuplot scripts, but no pictures"
             : gnuplot + ": draws the pictures of `crackle-bench`");
    const bool coloured = !styled("", Style::heading, Stream::out).empty();
    line("terminal", !is_terminal(Stream::out) ? "none: no colours, no progress line"
                     : coloured                ? "colours and a progress line"
                                               : "a progress line, no colours (NO_COLOR)");
    const std::vector<std::string> missing = missing_parts(page > 0, studies.empty() || !gnuplot.empty());
    if (missing.empty()) line("missing", "nothing");
    for (const std::string& part : missing) line("missing", part);
    return exit_done;
}

}  // namespace crackle::tools
