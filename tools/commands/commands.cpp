// SPDX-License-Identifier: GPL-3.0-or-later
// The table of commands, and the way from the words of a call to the command.

#include "tools/commands/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <string>

#include "solver/base/errors.hpp"
#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

const Command* named(const std::vector<Command>& commands, const std::string& name) {
    for (const Command& command : commands) {
        if (name == command.name) return &command;
    }
    return nullptr;
}

Arguments names_of(const std::vector<Command>& commands) {
    Arguments names;
    for (const Command& command : commands) names.emplace_back(command.name);
    return names;
}

bool asks_for_help(const std::string& word) { return word == "--help" || word == "-h"; }

void list(std::ostream& out, const std::vector<Command>& commands) {
    for (const Command& command : commands) out << fmt::format("  {:<12}{}\n", command.name, command.summary);
}

void print_overview(std::ostream& out, Stream stream) {
    out << "crackle: makes bonded rock specimens and tests them\n\n"
        << styled("usage:", Style::heading, stream)
        << " crackle COMMAND [OPTIONS]   (crackle COMMAND --help shows examples)\n\n";
    list(out, commands());
    out << "\nexit codes: ";
    for (const ExitCode& code : exit_codes())
        out << (code.code == exit_done ? "" : ", ") << code.code << ' ' << code.meaning;
    out << '\n';
}

int call(const Command& command, const std::string& name, const Arguments& words) {
    const bool itself = command.run != nullptr && (command.studies == nullptr || words.empty() ||
                                                   (!asks_for_help(words[0]) && !named(command.studies(), words[0])));
    if (!itself) {
        const std::vector<Command>& studies = command.studies();
        const std::string known = fmt::format("{}", fmt::join(names_of(studies), ", "));
        if (words.empty()) throw InputError(fmt::format("{}: found no study, expected one of {}", name, known));
        if (asks_for_help(words[0])) {
            print_help(command.describe());
            std::cout << '\n'
                      << styled(command.run == nullptr ? "studies:" : "further:", Style::heading, Stream::out) << '\n';
            list(std::cout, studies);
            return exit_done;
        }
        const Command* study = named(studies, words[0]);
        if (study == nullptr) {
            throw InputError(fmt::format("{}: found study '{}', expected one of {}", name, words[0], known));
        }
        return call(*study, name + ' ' + study->name, {words.begin() + 1, words.end()});
    }
    const CommandLine line = command.describe();
    const ParsedWords parsed = parse_words(name, line, words);
    if (parsed.help) {
        print_help(line);
        return exit_done;
    }
    Messages messages(parsed.loudness);
    return command.run({parsed.values, parsed.operands, words, messages});
}

}  // namespace

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"pack", "random circles in a box, compressed to equilibrium: in_gm.dat", describe_pack, pack},
        {"mesh", "polygon particles from a packing or a list of seeds: in_gm_tri.dat, in_gm_volo.dat", describe_mesh,
         mesh},
        {"run", "runs a DEMseg deck (in_gm.dat, in_bc.dat) and writes DEMseg's outputs", describe_run, run_deck},
        {"test", "one virtual test: specimen, bonding, platens, loading; curve, events, summary, frames", describe_test,
         test},
        {"elastic", "the same specimen by a sparse solve: moduli, first break and slip, stable time step",
         describe_elastic, elastic},
        {"campaign", "a table of tests on all processors or a cluster: means, scatter, bias", describe_campaign,
         campaign, campaign_studies},
        {"envelope", "strength over confinement: Mohr-Coulomb, Hoek-Brown, with intervals and Mohr circles",
         describe_envelope, envelope},
        {"calibrate", "a rock's keys from its laboratory values: cases, intervals, what is out of reach",
         describe_calibrate, calibrate_rock},
        {"report", "one self-contained HTML page from the results of tests", describe_report, report},
        {"view", "a page to look at a particle file, a deck's run or tests, in motion", describe_view, view},
        {"plot", "figures for papers: curves, breaks, specimens, as SVG, PDF or PNG", describe_plot, plot},
        {"bench", "studies of the engine itself: verification against closed forms", describe_bench, nullptr,
         bench_studies},
        {"doctor", "what this build is made of and what it can do", describe_doctor, doctor},
        {"completion", "a script by which bash, zsh or fish completes crackle's words", describe_completion,
         completion},
        {"man", "the manual page", describe_manual, manual},
    };
    return all;
}

const std::vector<ExitCode>& exit_codes() {
    static const std::vector<ExitCode> all{
        {exit_done, "done"},
        {exit_claim_fails, "a row of crackle bench fails, a target of crackle calibrate is not reached"},
        {exit_bad_input, "bad input"},
        {exit_unstable, "the run became unstable (its output so far is kept)"},
        {exit_system_fails, "the system or a library failed (likewise)"},
        {exit_interrupted, "interrupted (likewise)"},
    };
    return all;
}

int call_command(const Arguments& words) {
    if (words.empty()) {
        print_overview(std::cerr, Stream::err);
        return exit_bad_input;
    }
    const bool help = words[0] == "help";
    if (asks_for_help(words[0]) || (help && words.size() == 1)) {
        print_overview(std::cout, Stream::out);
        return exit_done;
    }
    if (words[0] == "--version") {
        print_version();
        return exit_done;
    }
    // `crackle help bench verify` is `crackle bench verify --help`.
    Arguments asked(words.begin() + (help ? 1 : 0), words.end());
    if (help) asked.emplace_back("--help");
    const Command* command = named(commands(), asked[0]);
    if (command == nullptr) {
        report_error(fmt::format("found command '{}', expected one of those below{}\n", asked[0],
                                 suggestion(asked[0], names_of(commands()))));
        print_overview(std::cerr, Stream::err);
        return exit_bad_input;
    }
    return call(*command, std::string("crackle ") + command->name, {asked.begin() + 1, asked.end()});
}

}  // namespace crackle::tools
