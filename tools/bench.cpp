// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle bench STUDY`: studies of the engine itself, each of which can write its page.

#include "tools/bench.hpp"

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "solver/errors.hpp"
#include "tools/commands.hpp"

namespace crackle::tools {
namespace {

const std::vector<Command>& studies() {
    static const std::vector<Command> all{
        {"accuracy", "what an error costs in processor time: contact laws, integrators, time steps, rates",
         bench_accuracy},
        {"features", "what each feature costs a contact and step, and what is left of absent ones", bench_features},
        {"guide", "the rock of DEMseg's guide on many packings: each of its numbers beside ours", bench_guide},
        {"stress", "scenes that are hard on the engine, for a million steps", bench_stress},
        {"throughput", "particle-steps a second beside what the machine can do", bench_throughput},
        {"verify", "every closed form and law that the engine has to meet, against what it does", bench_verify},
    };
    return all;
}

std::string names() {
    std::string text;
    for (const Command& study : studies()) text += (text.empty() ? "" : ", ") + std::string(study.name);
    return text;
}

void print_help(std::ostream& out) {
    out << "usage: crackle bench STUDY [OPTIONS]   (crackle bench STUDY --help shows examples)\n\nstudies:\n";
    for (const Command& study : studies()) out << fmt::format("  {:<12}{}\n", study.name, study.summary);
    out << "\nexample:\n  crackle bench verify -o verification.md\n  crackle bench guide --quick\n  crackle bench "
           "features --quick\n  crackle bench accuracy -o accuracy --quick\n  crackle bench stress --steps 10000\n  "
           "crackle bench throughput --quick\n";
}

}  // namespace

int bench(const Arguments& arguments) {
    if (arguments.empty()) throw InputError("bench: found no study, expected one of " + names());
    if (arguments[0] == "--help" || arguments[0] == "-h") {
        print_help(std::cout);
        return exit_done;
    }
    for (const Command& study : studies()) {
        if (arguments[0] == study.name) return study.run({arguments.begin() + 1, arguments.end()});
    }
    throw InputError(fmt::format("bench: found study '{}', expected one of {}", arguments[0], names()));
}

}  // namespace crackle::tools
