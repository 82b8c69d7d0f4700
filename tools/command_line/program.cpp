// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/command_line/program.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/base/version.hpp"
#include "tools/command_line/build_commit.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/terminal.hpp"

#ifdef __SANITIZE_ADDRESS__
// Leak checking is off: it would double the time of a short command, and the operating system frees all memory when a
// command ends. Unit tests check the functions for leaks.
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

SelectedCommand ended(int code) {
    SelectedCommand nothing;
    nothing.code = code;
    return nothing;
}

/// Parses the words after a command's name, or prints its help.
SelectedCommand selected(const Command& command, const std::string& name, const Arguments& words) {
    if (command.studies != nullptr && !words.empty()) {
        if (const Command* study = named(command.studies(), words[0]))
            return selected(*study, name + ' ' + study->name, {words.begin() + 1, words.end()});
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
        return {};
    }
    SelectedCommand chosen;
    chosen.run = command.run;
    chosen.messages = std::make_unique<Messages>(parsed.loudness);
    chosen.given.reset(new Invocation{parsed.values, parsed.operands, words, *chosen.messages});
    return chosen;
}

/// The command selected by the words after the program's name. Requests such as --help and --version are answered here
/// by printing; no command is then selected.
SelectedCommand selected(const Program& program, const Arguments& words) {
    if (words.empty()) {
        print_overview(program, std::cerr, Stream::err);
        return ended(exit_bad_input);
    }
    const bool help = words[0] == "help";
    if (asks_for_help(words[0]) || (help && words.size() == 1)) {
        print_overview(program, std::cout, Stream::out);
        return {};
    }
    if (words[0] == "--version") {
        fmt::print("{} {}\ncommit {}\nresults version {}\n", program.name, project_version, build_commit,
                   results_version);
        return {};
    }
    // `crackle help campaign show` means `crackle campaign show --help`.
    Arguments asked(words.begin() + (help ? 1 : 0), words.end());
    if (help) asked.emplace_back("--help");
    const Command* command = named(program.commands(), asked[0]);
    if (command == nullptr) {
        report_error(fmt::format("found {} '{}', expected one of those below{}\n", program.first_word, asked[0],
                                 suggestion(asked[0], names_of(program.commands()))));
        print_overview(program, std::cerr, Stream::err);
        return ended(exit_bad_input);
    }
    return selected(*command, fmt::format("{} {}", program.name, command->name), {asked.begin() + 1, asked.end()});
}

/// Whether standard output is a pipe whose reader has closed it.
bool reader_is_gone() {
    pollfd output{STDOUT_FILENO, 0, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// Refuses a stack limit that is too small for a thread. @throws SystemFailure
void refuse_small_stack() {
    constexpr rlim_t least = rlim_t{1} << 20;  // bytes; file readers, solvers and fonts use a tenth to a half of it
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur == RLIM_INFINITY || stack.rlim_cur >= least) return;
    throw SystemFailure(
        fmt::format("found a stack limit of {} KiB, expected at least {}; raise the limit (ulimit -s {})",
                    stack.rlim_cur >> 10, least >> 10, least >> 10));
}

}  // namespace

const std::vector<ExitCode>& exit_codes() {
    static const std::vector<ExitCode> all{
        {exit_done, "done"},
        {exit_claim_fails,
         "a check of crackle-bench fails, a target of crackle calibrate is not reached, or tests of crackle campaign "
         "end without a result"},
        {exit_bad_input, "bad input"},
        {exit_unstable, "the run became unstable (the output so far is kept)"},
        {exit_system_fails, "the operating system or a library failed (the output so far is kept)"},
        {exit_interrupted, "interrupted (the output so far is kept)"},
    };
    return all;
}

SelectedCommand::SelectedCommand() = default;
SelectedCommand::SelectedCommand(SelectedCommand&&) noexcept = default;
SelectedCommand::~SelectedCommand() = default;

SelectedCommand select_command(const Program& program, int argc, char** argv) {
    // Makes glibc return freed arrays of large specimens to the operating system. By default it keeps arrays after the
    // first ones were freed, and rebuilding a neighbour list would then need as much memory as the whole specimen.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 22);
    const auto all = std::span(argv, static_cast<std::size_t>(argc));
    name_program(program.name);
    make_writing_fail_by_error();
    refuse_small_stack();
    chosen_set();  // refuses an invalid CRACKLE_ISA before any work is done
    return selected(program, {all.begin() + 1, all.end()});
}

int end_output(int code) {
    // Fails if the result cannot be written to stdout; a full disc may cause an error only when the last bytes are
    // written.
    errno = 0;
    const bool written = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (written || code != exit_done) return code;
    if (reader_is_gone()) return exit_system_fails;  // the reader, such as `| head`, needs no more output
    report_error(fmt::format("standard output: {}, expected enough space for the output",
                             errno != 0 ? std::generic_category().message(errno) : "cannot be written"));
    return exit_system_fails;
}

int report_failure(const char* called) {
    try {
        throw;
    } catch (const InputError& error) {
        report_error(error.what());
        return exit_bad_input;
    } catch (const std::filesystem::filesystem_error& error) {
        report_error(fmt::format("{}: {}, expected a path that can be read and written; check its permissions",
                                 error.path1().string(), error.code().message()));
        return is_about_the_path(error.code().value()) ? exit_bad_input : exit_system_fails;
    } catch (const std::bad_alloc&) {
        report_error("ran out of memory for this input; make the specimen smaller");
        return exit_system_fails;
    } catch (const UnstableRun& error) {
        report_error(error.what());
        return exit_unstable;
    } catch (const SystemFailure& error) {
        report_error(error.what());
        return exit_system_fails;
    } catch (const std::system_error& error) {
        if (reader_is_gone())
            return exit_system_fails;  // the reader closed the pipe while the result was being printed
        report_error(fmt::format("{}: {}", called, error.what()));
        return exit_system_fails;
    } catch (const std::exception& error) {  // thrown by a library, so the message lacks the context of the command
        report_error(fmt::format("{}: unexpected error '{}'; please report it with the command and its files", called,
                                 error.what()));
        return exit_system_fails;
    }
}

}  // namespace crackle::tools
