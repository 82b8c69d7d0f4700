// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle COMMAND ...`: finds the subcommand, runs it, turns failures into one message and an exit code.

#include <malloc.h>

#include <boost/program_options/errors.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "solver/errors.hpp"
#include "tools/commands.hpp"

namespace crackle::tools {
namespace {

// Kept in the order of a user's work.
const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"pack", "random circles in a box, compressed to equilibrium: in_gm.dat", pack},
        {"mesh", "polygon particles from a packing or a list of seeds: in_gm_tri.dat, in_gm_volo.dat", mesh},
        {"run", "runs a DEMseg deck (in_gm.dat, in_bc.dat) and writes DEMseg's outputs", run_deck},
        {"test", "one virtual test: specimen, bonding, platens, loading; curve, events, summary, frames", test},
        {"elastic", "the same specimen by a sparse solve: moduli, first break and slip, stable time step", elastic},
        {"report", "one self-contained HTML page from the results of tests", report},
        {"bench", "studies of the engine itself: verification against closed forms", bench},
        {"doctor", "what this build is made of and what it can do", doctor},
    };
    return all;
}

void print_help(std::ostream& out) {
    out << "crackle: makes bonded rock specimens and tests them\n\nusage: crackle COMMAND [OPTIONS]   (crackle COMMAND "
           "--help shows examples)\n\n";
    for (const Command& command : commands()) {
        out << "  " << command.name << std::string(12 - std::string(command.name).size(), ' ') << command.summary
            << '\n';
    }
    out << "\nexit codes: 0 done, 1 a verification row fails, 2 bad input, 3 the run became unstable, 130 "
           "interrupted\n";
}

int run(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
        print_help(words.empty() ? std::cerr : std::cout);
        return words.empty() ? exit_bad_input : exit_done;
    }
    if (words[0] == "--version") return version({});
    for (const Command& command : commands()) {
        if (words[0] == command.name) return command.run({words.begin() + 1, words.end()});
    }
    std::cerr << "crackle: found command '" << words[0] << "', expected one of those below\n\n";
    print_help(std::cerr);
    return exit_bad_input;
}

}  // namespace
}  // namespace crackle::tools

int main(int argc, char** argv) {
    using namespace crackle::tools;
    // Arrays of large specimens go back to the system when they are freed. By itself glibc soon keeps them for good:
    // a list of neighbours built anew would then cost as much memory as the whole specimen.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 22);
    const auto all = std::span(argv, static_cast<std::size_t>(argc));
    try {
        return run({all.begin() + 1, all.end()});
    } catch (const crackle::InputError& error) {
        std::cerr << "crackle: " << error.what() << '\n';
        return exit_bad_input;
    } catch (const std::filesystem::filesystem_error& error) {
        std::cerr << "crackle: " << error.path1().string() << ": " << error.code().message()
                  << ", expected a path that can be read and written; check its permissions\n";
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        std::cerr << "crackle: found less memory than the input needs; make the specimen smaller\n";
        return exit_bad_input;
    } catch (const boost::program_options::error& error) {
        std::cerr << "crackle: " << error.what() << " (see --help)\n";
        return exit_bad_input;
    } catch (const crackle::UnstableRun& error) {
        std::cerr << "crackle: " << error.what() << '\n';
        return exit_unstable;
    }
}
