// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what all commands have in common: --help, --version, the manual page, completion, verbosity, colours and
// progress.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "solver/base/version.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_rock.hpp"
#include "tests/support/terminal_call.hpp"

namespace crackle {
namespace {

using testing::Answer;
using testing::call_on_terminal;
using testing::TerminalAnswer;
using Words = std::vector<std::string>;

constexpr const char* redraw = "\r\x1b[K";

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
    return count;
}

/// The names in the table after a line of a text such as `crackle --help`.
Words listed(const std::string& text) {
    Words names;
    const std::regex row("\n  ([a-z]+)  +[^ \n-]");
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found)
        names.push_back((*found)[1]);
    return names;
}

/// Options such as "--kind" in the text of --help.
Words options_in(const std::string& help) {
    Words names;
    const std::regex row("\n  (?:-[a-z], |    )(--[a-z-]+)");
    for (std::sregex_iterator found(help.begin(), help.end(), row), end; found != end; ++found)
        names.push_back((*found)[1]);
    return names;
}

class CommandLines : public testing::ProgramCall {
  protected:
    CommandLines() : ProgramCall("") {}

    /// All commands except `bench`, whose options are those of another program.
    Words commands() const {
        Words all = listed(call("--help").out);
        std::erase(all, "bench");
        return all;
    }

    Answer shell(const std::string& command) const {
        const int status =
            std::system(fmt::format("cd '{}' && PATH=\"$(dirname '{}'):$PATH\" && ({}) > out.txt 2> err.txt",
                                    folder_.string(), CRACKLE_PROGRAM, command)
                            .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out_), read(err_)};
    }

    /// Completions that bash offers for the last of these words.
    std::set<std::string> completed(const Words& words) const {
        std::string list;
        for (const std::string& word : words) list += fmt::format(" '{}'", word);
        const Answer answer = shell(
            fmt::format("bash -c 'source <(crackle completion bash); COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); "
                        "_crackle; printf \"%s\\n\" \"${{COMPREPLY[@]}}\"' bash{}",
                        list));
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(answer.err, "");
        std::set<std::string> offered;
        std::istringstream lines(answer.out);
        for (std::string line; std::getline(lines, line);) {
            if (!line.empty()) offered.insert(line);
        }
        return offered;
    }

    const std::string pack_ = "pack --count 60 --radius-min 0.01 --radius-max 0.02 --mean-overlap 2e-5 ";
};

TEST_F(CommandLines, HelpOfEveryCommandHasUsageOptionsAndExamples) {
    const Words all = commands();
    EXPECT_GE(all.size(), 15U);
    for (const std::string& command : all) {
        for (const char* option : {" --help", " -h"}) {
            const Answer answer = call(command + option);
            EXPECT_EQ(answer.code, 0) << command << answer.err;
            EXPECT_EQ(answer.err, "") << command;
            for (const std::string& part :
                 {"usage: crackle " + command, std::string("\noptions:\n"), std::string("\nexamples:\n  "),
                  std::string("  -q, --quiet  "), std::string("  -v, --verbose  "), std::string("  -h, --help  ")})
                EXPECT_NE(answer.out.find(part), std::string::npos) << command << ": " << part << '\n' << answer.out;
            std::istringstream lines(answer.out);
            for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 140U) << command << ": " << line;
        }
    }
    EXPECT_EQ(call("help mesh").out, call("mesh --help").out);
    EXPECT_EQ(call("help campaign show").out, call("campaign show --help").out);
    const std::string campaign = call("campaign --help").out;
    EXPECT_NE(campaign.find("\nfurther:\n  show "), std::string::npos) << campaign;
    fmt::print("  {} commands\n", all.size());
}

TEST_F(CommandLines, ManualPageIsSoundRoffAndNamesEveryOption) {
    const Answer page = shell("crackle man | groff -man -ww -Tascii -P-cbou -rLL=200n");
    ASSERT_EQ(page.code, 0) << "groff, Debian's groff-base: " << page.err;
    EXPECT_EQ(page.err, "");
    const Answer narrow = shell("crackle man | groff -man -ww -Tutf8 -rLL=78n");
    EXPECT_EQ(narrow.err, "") << "no warning at the width of a terminal";
    std::size_t options = 0;
    for (const std::string& command : commands()) {
        const std::size_t begin = page.out.find("\n   crackle " + command + '\n');
        ASSERT_NE(begin, std::string::npos) << command << '\n' << page.out;
        const std::string section = page.out.substr(begin, page.out.find("\n   crackle ", begin + 1) - begin);
        for (const std::string& option : options_in(call(command + " --help").out)) {
            ++options;
            EXPECT_TRUE(std::regex_search(section, std::regex("\n +(-[a-z], )?" + option + "( |\n)")))
                << command << ' ' << option;
        }
    }
    EXPECT_GT(options, 100U);
    for (const char* part : {"NO_COLOR", "EXIT STATUS", "130", "checkpoint", "crackle test --resume out/case"})
        EXPECT_NE(page.out.find(part), std::string::npos) << part;
    fmt::print("  {} options, {} bytes\n", options, page.out.size());
}

TEST_F(CommandLines, AResultThatCannotBePrintedIsNoSuccess) {
    for (const char* command : {"doctor", "man", "--help", "test --keys", "completion bash"}) {
        const Answer answer = shell(std::string("crackle ") + command + " > /dev/full");
        EXPECT_EQ(answer.code, 4) << command;
        EXPECT_NE(answer.err.find("standard output: "), std::string::npos) << command << ": " << answer.err;
        EXPECT_EQ(count_of(answer.err, "\n"), 1U) << answer.err;
    }
}

// A reader may stop at the end, or within a text longer than the buffer of a pipe.
TEST_F(CommandLines, AReaderThatHasSeenEnoughIsNoError) {
    for (const char* command : {"crackle test --help", "(for i in $(seq 40); do crackle test --keys; done)"}) {
        const Answer answer = shell(fmt::format("({}) | head -1", command));
        EXPECT_EQ(answer.code, 0) << command;
        EXPECT_EQ(answer.err, "") << command;
    }
    const Answer answer = shell("(sleep 0.2; crackle test --keys; echo $? >&2) | true");
    EXPECT_EQ(answer.err, "4\n");
}

TEST_F(CommandLines, WhatFilesAreCalledCannotReachTheTerminal) {
    const Answer answer = shell("crackle test \"$(printf '\\033[31mred\\007.toml')\" -o out");
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.err.find("\\x1b[31mred\\x07.toml"), std::string::npos) << answer.err;
    EXPECT_EQ(answer.err.find('\x1b'), std::string::npos);
}

// A title and paths with control sequences that change colours, cursor and title of the terminal, in C0 and in C1.
TEST_F(CommandLines, ResultsCannotCommandTheTerminal) {
    const std::string hostile =
        "a\x1b[31m\x1b]0;b\x07\xc2\x9b"
        "31m\x9b";
    ASSERT_EQ(call(pack_ + "-o specimen.dat").code, 0);
    for (const std::string& words :
         {pack_ + "-o '" + hostile + ".dat'", "mesh specimen.dat --kind delaunay --thick 1e-5 -o '" + hostile + ".dat'",
          "view specimen.dat -o '" + hostile + ".html'", "view '" + hostile + "'", "'frobnicate" + hostile + "'"}) {
        const std::string shown = call_on_terminal(folder_, words, {{"NO_COLOR", "1"}}).shown;
        for (const char* raw : {"\x1b[31m", "\x1b]", "\x07", "\xc2\x9b", "\x9b"})
            EXPECT_EQ(shown.find(raw), std::string::npos) << words << '\n' << shown;
        EXPECT_NE(shown.find("\\x1b[31m\\x1b]0;b\\x07\\u009b31m\\x9b"), std::string::npos) << shown;
    }
}

TEST_F(CommandLines, ASmallStackIsRefused) {
    const Answer answer = shell("ulimit -s 128; crackle doctor");
    EXPECT_EQ(answer.code, 4);
    EXPECT_EQ(answer.err,
              "crackle: found a stack limit of 128 KiB, expected at least 1024; raise the limit (ulimit -s 1024)\n");
    EXPECT_EQ(shell("ulimit -s 1024; crackle doctor").code, 0);
}

TEST_F(CommandLines, MessagesHaveAnEnd) {
    const Answer answer = shell("crackle test \"$(head -c 100000 /dev/zero | tr '\\0' x)\" -o out");
    EXPECT_EQ(answer.code, 2);
    EXPECT_LT(answer.err.size(), 2200U);
    EXPECT_NE(answer.err.find("bytes more)"), std::string::npos);
}

TEST_F(CommandLines, VersionNamesTheProgramsTheCommitsAndTheResults) {
    const Answer answer = call("--version");
    EXPECT_EQ(answer.code, 0);
    const std::regex three_lines(
        fmt::format("crackle {}\ncommit ([0-9a-f]{{12}}(, with changes)?|unknown: .+)\nresults version {}\n",
                    project_version, results_version));
    EXPECT_TRUE(std::regex_match(answer.out, three_lines)) << answer.out;
}

TEST_F(CommandLines, BashCompletesCommandsOptionsAndTheirWords) {
    const Words all = listed(call("--help").out);
    std::set<std::string> expected(all.begin(), all.end());
    expected.insert({"--help", "--version"});
    EXPECT_EQ(completed({"crackle", ""}), expected);
    EXPECT_EQ(completed({"crackle", "me"}), std::set<std::string>{"mesh"});
    for (const std::string& command : commands()) {
        Words words{"crackle"};
        std::istringstream names(command);
        for (std::string name; names >> name;) words.push_back(name);
        words.emplace_back("--");
        const Words options = options_in(call(command + " --help").out);
        EXPECT_EQ(completed(words), std::set<std::string>(options.begin(), options.end())) << command;
    }
    EXPECT_EQ(completed({"crackle", "mesh", "in.dat", "--kind", ""}), (std::set<std::string>{"delaunay", "voronoi"}));
    EXPECT_EQ(completed({"crackle", "mesh", "--kind", "=", "v"}), std::set<std::string>{"voronoi"});
    EXPECT_EQ(completed({"crackle", "campaign", "sho"}), std::set<std::string>{"show"});
    EXPECT_EQ(completed({"crackle", "plot", "--what", "curve", "s"}),
              (std::set<std::string>{"scatter", "strain", "specimen"}))
        << "an option that takes several words";
    EXPECT_EQ(completed({"crackle", "completion", "f"}), std::set<std::string>{"fish"});
    std::filesystem::create_directory(folder_ / "two words");
    write("two words.toml", "");
    EXPECT_EQ(completed({"crackle", "test", "two"}), (std::set<std::string>{"two words", "two words.toml"})) << "files";
    EXPECT_EQ(completed({"crackle", "test", "case.toml", "-o", "two"}).size(), 2U);
}

TEST_F(CommandLines, CompletionsOfOtherShellsNameTheSameWords) {
    const std::string zsh = call("completion zsh").out, fish = call("completion fish").out;
    EXPECT_NE(zsh.find("bashcompinit"), std::string::npos);
    for (const std::string& command : commands()) {
        EXPECT_NE(zsh.find('\'' + command + "')"), std::string::npos) << command;
        for (const std::string& option : options_in(call(command + " --help").out)) {
            EXPECT_NE(fish.find(fmt::format("'__crackle_calls {}' -l {} ", command, option.substr(2))),
                      std::string::npos)
                << command << ' ' << option;
        }
    }
    expect_refused("completion tcsh", "found tcsh, expected bash, zsh or fish");
    expect_refused("completion", "found nothing, expected bash, zsh or fish");
}

TEST_F(CommandLines, WordsThatAreNearlyRightAreGuessed) {
    const Answer command = call("tset");
    EXPECT_EQ(command.code, 2);
    EXPECT_NE(command.err.find("did you mean test?"), std::string::npos) << command.err;
    expect_refused("pack --cuont 3", "did you mean --count?");
    expect_refused("doctor --frobnicate", "unrecognised option '--frobnicate' (see crackle doctor --help)");
    expect_refused("pack --count=50.0",
                   "the argument ('50.0') for option '--count' is invalid, expected a whole number");
    expect_refused("pack --width wide", "the argument ('wide') for option '--width' is invalid, expected a number");
    expect_refused("doctor now", "found 'now', expected options alone");
    expect_refused("run one two", "found 'two', expected one DIR");
    expect_refused("doctor -q -v", "found --quiet and --verbose, expected only one of them");
    expect_refused("mesh rock.dat --kind", "crackle mesh: the required argument");
}

/// A copy of crackle in a separate folder, without the programs built beside it.
class Bench : public CommandLines {
  protected:
    Bench() {
        std::filesystem::create_directories(folder_ / "alone");
        std::filesystem::copy_file(CRACKLE_PROGRAM, folder_ / "alone/crackle");
    }

    /// Writes a program with the name that crackle searches for. It prints its folder and its arguments, one per line.
    void write_bench(const std::string& folder) const {
        std::filesystem::create_directories(folder_ / folder);
        write(folder + "/crackle-bench", "#!/bin/sh\nprintf '%s\\n' " + folder + " \"$@\"\nexit 7\n");
        std::filesystem::permissions(folder_ / folder / "crackle-bench", std::filesystem::perms::owner_all);
    }

    /// @param path the PATH, with folders in the temporary folder
    Answer alone(const std::string& words, const std::string& path = "none") const {
        return shell(fmt::format("PATH='{}/{}' alone/crackle {}", folder_.string(), path, words));
    }
};

TEST_F(Bench, IsStartedWithTheSameWordsAndEndsWithItsCode) {
    write_bench("on_path");
    const Answer answer = alone("bench verify --only 'two words' -o -q --help", "on_path");
    EXPECT_EQ(answer.code, 7) << answer.err;
    EXPECT_EQ(answer.out, "on_path\nverify\n--only\ntwo words\n-o\n-q\n--help\n");
    EXPECT_EQ(answer.err, "");
    EXPECT_EQ(alone("bench", "on_path").out, "on_path\n");
    EXPECT_EQ(alone("help bench verify", "on_path").out, "on_path\nverify\n--help\n");
    write_bench("alone");
    EXPECT_EQ(alone("bench verify", "on_path").out, "alone\nverify\n") << "a program next to crackle comes first";
    const std::string version = call("--version").out;
    EXPECT_EQ(call("bench --version").out, "crackle-bench" + version.substr(version.find(' ')))
        << "the program built in the same folder";
}

TEST_F(Bench, SaysWhereToGetItWhereItIsNot) {
    std::filesystem::create_directories(folder_ / "none/crackle-bench");  // a folder is not a program
    const Answer answer = alone("bench verify --list");
    EXPECT_EQ(answer.code, 2);
    EXPECT_EQ(answer.out, "");
    EXPECT_EQ(count_of(answer.err, "\n"), 1U) << answer.err;
    for (const char* part :
         {"crackle bench: found no crackle-bench, expected this program in the same folder as crackle or on the PATH",
          "package crackle-bench", "cmake --build --preset release --target crackle-bench"})
        EXPECT_NE(answer.err.find(part), std::string::npos) << part << '\n' << answer.err;
    const Answer help = alone("bench --help");
    EXPECT_EQ(help.code, 0) << help.err;
    EXPECT_TRUE(help.out.starts_with("usage: crackle bench STUDY [OPTIONS]")) << help.out;
    EXPECT_EQ(alone("help bench").out, help.out);
    const std::string doctor = alone("doctor").out;
    EXPECT_NE(doctor.find("crackle-bench not found"), std::string::npos) << doctor;
    EXPECT_EQ(doctor.find("missing       gnuplot"), std::string::npos) << doctor;
}

/// Each command that writes files: its words and the files it reads.
TEST_F(CommandLines, QuietSaysNothingAndVerboseSaysMore) {
    testing::write_small_case(folder_, {.output = "curve_rows = 2000\nframes = 5"});
    const std::string deck = std::string(CRACKLE_SOURCE_DIR) + "/specimens/demseg/circle";
    const bool page = call("doctor").out.find("embedded") != std::string::npos;
    for (const std::string& words :
         {pack_ + "--force -o rock2.dat", std::string("mesh rock.dat --kind voronoi --thick 1e-3 --force -o cells.dat"),
          "run '" + deck + "' -o deck --steps 200 --force", std::string("test case.toml -o out --force"),
          std::string("report out -o report.html"), std::string("view rock.dat -o view.html")}) {
        if (!page && (words.starts_with("report") || words.starts_with("view"))) continue;
        const Answer usual = call(words), quiet = call(words + " -q"), verbose = call(words + " -v");
        EXPECT_EQ(usual.code, 0) << words << usual.err;
        EXPECT_EQ(quiet.code, 0) << words << quiet.err;
        EXPECT_EQ(verbose.code, 0) << words << verbose.err;
        EXPECT_EQ(quiet.out + quiet.err, "") << words;
        EXPECT_GT(count_of(verbose.err, "\n"), count_of(usual.err, "\n")) << words << verbose.err;
        EXPECT_NE(verbose.err.find(" s    +0."), std::string::npos) << "seconds of the stages\n" << verbose.err;
        fmt::print("{}", verbose.err);
    }
    // If the result is printed, -q does not suppress it.
    EXPECT_NE(call("elastic case.toml -q").out.find("Young's modulus"), std::string::npos);
    EXPECT_EQ(call("elastic case.toml -q").err, "");
    EXPECT_EQ(call("doctor -q").out, call("doctor").out);
}

TEST_F(CommandLines, VerboseTestTellsStagesStepThreadsAndBytes) {
    testing::write_small_case(folder_, {.mesh = "voronoi"});
    const Answer verbose = call("test case.toml -o out -v --threads 2");
    ASSERT_EQ(verbose.code, 0) << verbose.err;
    for (const char* part :
         {"meshed into", "bonded ", "small strain", "contact points touch", "time step", "guaranteed bound",
          "steps to max_axial_strain", "1 of 2 threads are used", "on 1 threads", "bytes in out"})
        EXPECT_NE(verbose.err.find(part), std::string::npos) << part << '\n' << verbose.err;
}

TEST_F(CommandLines, ColoursAreForTerminalsAloneAndNotUnderNoColor) {
    EXPECT_EQ(call("frobnicate").err.find('\x1b'), std::string::npos) << "in a pipe";
    EXPECT_EQ(call("test --help").out.find('\x1b'), std::string::npos) << "in a pipe";
    const std::string error = "\x1b[1;31mcrackle:\x1b[0m", heading = "\x1b[1musage:\x1b[0m";
    const auto shown = [&](const std::string& words, const std::string& name = "CRACKLE_NOTHING",
                           const std::string& value = "") {
        return call_on_terminal(folder_, words, {{name, value}}).shown;
    };
    EXPECT_NE(shown("frobnicate").find(error), std::string::npos) << shown("frobnicate");
    EXPECT_NE(shown("pack").find("\x1b[1;31mcrackle"), std::string::npos) << shown("pack");
    EXPECT_NE(shown("test --help").find(heading), std::string::npos) << shown("test --help");
    EXPECT_NE(shown("frobnicate", "NO_COLOR", "").find(error), std::string::npos)
        << "an empty variable counts as not set";
    for (const char* words : {"frobnicate", "test --help", "--help"}) {
        EXPECT_EQ(shown(words, "NO_COLOR", "1").find('\x1b'), std::string::npos) << words;
        EXPECT_EQ(shown(words, "TERM", "dumb").find('\x1b'), std::string::npos) << words;
    }
}

TEST_F(CommandLines, ProgressIsShownOnATerminalAloneAndGoneInTheEnd) {
    testing::write_small_case(folder_, {.rate = 5e-5});
    const std::string words = "test case.toml -o out --force";
    const TerminalAnswer answer = call_on_terminal(folder_, words);
    ASSERT_EQ(answer.code, 0) << answer.shown;
    const std::size_t drawn = count_of(answer.shown, redraw);
    EXPECT_TRUE(std::regex_search(answer.shown, std::regex("[0-9]+ %  [0-9.e+]+ steps/s  .* left  strain")))
        << answer.shown;
    fmt::print("  drawn or taken away {} times in {:.2f} s\n", drawn, answer.seconds);
    EXPECT_GE(drawn, 2U);
    EXPECT_LE(static_cast<double>(drawn), 5.0 * answer.seconds + 12.0) << "at most five times a second, and the stages";
    // The line is removed completely: only the result follows the last redraw.
    const std::string rest = answer.shown.substr(answer.shown.rfind(redraw) + 4);
    EXPECT_TRUE(rest.starts_with("circles, tension: the specimen failed")) << rest;

    for (const std::string& more : {std::string(" -q"), std::string()}) {
        const TerminalAnswer silent =
            call_on_terminal(folder_, words + more, {{"TERM", more.empty() ? "dumb" : "xterm"}});
        EXPECT_EQ(count_of(silent.shown, redraw), 0U) << silent.shown;
    }
    const Answer piped = call(words);
    EXPECT_EQ(piped.err.find('\r'), std::string::npos) << piped.err;
    EXPECT_EQ((piped.out + piped.err).find('\x1b'), std::string::npos) << piped.err;
}

TEST_F(CommandLines, ProgressLineFitsATerminal) {
    testing::write_small_case(folder_, {.rate = 5e-5});
    const TerminalAnswer answer = call_on_terminal(folder_, "test case.toml -o out", {}, 40);
    ASSERT_EQ(answer.code, 0);
    for (std::size_t at = answer.shown.find(redraw); at != std::string::npos; at = answer.shown.find(redraw, at + 1)) {
        const std::string line = answer.shown.substr(at + 4, answer.shown.find_first_of("\r\n", at + 4) - at - 4);
        if (line.find('%') != std::string::npos) {
            EXPECT_LT(line.size(), 40U) << line;
        }
    }
}

TEST_F(CommandLines, ProgressOfEveryLongCommandIsShown) {
    const std::string deck = std::string(CRACKLE_SOURCE_DIR) + "/specimens/demseg/circle";
    for (const auto& [words, says] : std::vector<std::pair<std::string, std::string>>{
             {"pack --count 3000 --radius-min 0.01 --radius-max 0.02 --mean-overlap 2e-5 -o rock.dat", "unbalanced by"},
             {"mesh rock.dat --kind voronoi --thick 1e-4 -o cells.dat", "meshing 3000 centres"},
             {"run '" + deck + "' -o deck", "%"}}) {
        const TerminalAnswer answer = call_on_terminal(folder_, words);
        EXPECT_EQ(answer.code, 0) << answer.shown;
        const std::size_t at = answer.shown.find(redraw);
        ASSERT_NE(at, std::string::npos) << words;
        EXPECT_NE(answer.shown.find(says, at), std::string::npos) << words << '\n' << answer.shown;
    }
}

TEST_F(CommandLines, DoctorSaysWhatIsThereAndWhatIsMissing) {
    const std::string report = call("doctor").out;
    for (const char* part : {"lanes", "instructions", "threads", "CGAL ", "Eigen ", "Spectra ", "cereal ", "xxHash ",
                             "ISA-L ", "OpenSSL ", "report page", "crackle-bench", "gnuplot", "missing"})
        EXPECT_NE(report.find(part), std::string::npos) << part << '\n' << report;
    const std::string without = shell("PATH=/nowhere '" + std::string(CRACKLE_PROGRAM) + "' doctor").out;
    EXPECT_NE(without.find("missing       gnuplot: apt-get install gnuplot-nox"), std::string::npos) << without;
    EXPECT_NE(call("doctor -v").out.find("flags"), std::string::npos);
}

}  // namespace
}  // namespace crackle
