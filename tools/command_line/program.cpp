// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/command_line/program.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "solver/base/version.hpp"
#include "tools/command_line/build_commit.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/terminal.hpp"

#ifdef __SANITIZE_ADDRESS__
// What a command leaves behind when it ends goes back to the system; leaks of what it calls show in the unit tests.
// Looking for them takes as long as all else of a short command.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }  // NOLINT: the sanitizer's own name
#endif

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

void print_overview(const Program& program, std::ostream& out, Stream stream) {
    std::string first_word;
    std::ranges::transform(std::string(program.first_word), std::back_inserter(first_word),
                           [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    out << program.name << ": " << program.summary << "\n\n"
        << styled("usage:", Style::heading, stream)
        << fmt::format(" {0} {1} [OPTIONS]   ({0} {1} --help shows examples)\n\n", program.name, first_word);
    list(out, program.commands());
    out << "\nexit codes: ";
    for (const ExitCode& code : exit_codes())
        out << (code.code == exit_done ? "" : ", ") << code.code << ' ' << code.meaning;
    out << '\n';
}

int call(const Command& command, const std::string& name, const Arguments& words) {
    if (command.studies != nullptr && !words.empty()) {
        if (const Command* study = named(command.studies(), words[0]))
            return call(*study, name + ' ' + study->name, {words.begin() + 1, words.end()});
    }
    const CommandLine line = command.describe();
    ParsedWords parsed;
    if (line.takes_options) {
        parsed = parse_words(name, line, words);
    } else {
        parsed.help = !words.empty() && asks_for_help(words[0]);
    }
    if (parsed.help) {
        print_help(line);
        if (command.studies != nullptr) {
            std::cout << '\n' << styled("further:", Style::heading, Stream::out) << '\n';
            list(std::cout, command.studies());
        }
        return exit_done;
    }
    Messages messages(parsed.loudness);
    return command.run({parsed.values, parsed.operands, words, messages});
}

/// What the words behind the program's name ask for. @throws what the command does
int call(const Program& program, const Arguments& words) {
    if (words.empty()) {
        print_overview(program, std::cerr, Stream::err);
        return exit_bad_input;
    }
    const bool help = words[0] == "help";
    if (asks_for_help(words[0]) || (help && words.size() == 1)) {
        print_overview(program, std::cout, Stream::out);
        return exit_done;
    }
    if (words[0] == "--version") {
        fmt::print("{} {}\ncommit {}\nresults version {}\n", program.name, project_version, build_commit,
                   results_version);
        return exit_done;
    }
    // `crackle help campaign show` is `crackle campaign show --help`.
    Arguments asked(words.begin() + (help ? 1 : 0), words.end());
    if (help) asked.emplace_back("--help");
    const Command* command = named(program.commands(), asked[0]);
    if (command == nullptr) {
        report_error(fmt::format("found {} '{}', expected one of those below{}\n", program.first_word, asked[0],
                                 suggestion(asked[0], names_of(program.commands()))));
        print_overview(program, std::cerr, Stream::err);
        return exit_bad_input;
    }
    return call(*command, fmt::format("{} {}", program.name, command->name), {asked.begin() + 1, asked.end()});
}

/// Of the standard output, a pipe.
bool reader_is_gone() {
    pollfd output{STDOUT_FILENO, 0, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

const std::vector<ExitCode>& exit_codes() {
    static const std::vector<ExitCode> all{
        {exit_done, "done"},
        {exit_claim_fails, "a row of crackle-bench fails, a target of crackle calibrate is not reached"},
        {exit_bad_input, "bad input"},
        {exit_unstable, "the run became unstable (its output so far is kept)"},
        {exit_system_fails, "the system or a library failed (likewise)"},
        {exit_interrupted, "interrupted (likewise)"},
    };
    return all;
}

int run_program(const Program& program, int argc, char** argv) {
    // Arrays of large specimens go back to the system when they are freed. By itself glibc soon keeps them for good:
    // a list of neighbours built again would then cost as much memory as the whole specimen.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 22);
    const auto all = std::span(argv, static_cast<std::size_t>(argc));
    const char* const called = argc > 1 ? argv[1] : program.name;
    name_program(program.name);
    make_writing_fail_by_error();
    try {
        chosen_set();  // refuses an unknown CRACKLE_ISA before anything is done
        const int code = call(program, {all.begin() + 1, all.end()});
        // Fails if the result cannot be written: a full disk shows with its last bytes.
        errno = 0;
        const bool written = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
        if (written || code != exit_done) return code;
        if (reader_is_gone()) return exit_system_fails;  // `| head` has seen what it wanted
        report_error(fmt::format("standard output: {}, expected one that takes all that is printed",
                                 errno != 0 ? std::generic_category().message(errno) : "cannot be written"));
        return exit_system_fails;
    } catch (const InputError& error) {
        report_error(error.what());
        return exit_bad_input;
    } catch (const std::filesystem::filesystem_error& error) {
        report_error(fmt::format("{}: {}, expected a path that can be read and written; check its permissions",
                                 error.path1().string(), error.code().message()));
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        report_error("found less memory than the input needs; make the specimen smaller");
        return exit_bad_input;
    } catch (const UnstableRun& error) {
        report_error(error.what());
        return exit_unstable;
    } catch (const std::system_error& error) {
        if (reader_is_gone()) return exit_system_fails;  // seen while printing still
        report_error(fmt::format("{}: {}, expected to go on", called, error.what()));
        return exit_system_fails;
    } catch (const std::exception& error) {  // of a library, which does not know what it was asked for
        report_error(fmt::format("{}: found '{}', expected to go on; please report it with the command and its files",
                                 called, error.what()));
        return exit_system_fails;
    }
}

}  // namespace crackle::tools
