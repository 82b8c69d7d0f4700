// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle man`: prints the manual page in roff, with the man macros.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "solver/base/utf8.hpp"
#include "specimens/results/output_folder.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/build_info.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

struct Term {
    const char* name;
    const char* text;
};

constexpr Term variables[] = {
    {"NO_COLOR", "if set to any value, disables colours"},
    {"TERM", "if unset or \"dumb\", disables colours and the progress line"},
};

/// Text escaped so that roff prints it unchanged: no line is read as a request, and hyphens can be copied as typed.
std::string literal(std::string_view text) {
    std::string out;
    bool line_begins = true;
    while (!text.empty()) {
        const auto [bytes, letter] = first_letter(text);
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
        if (line_begins && (letter == '.' || letter == '\'')) out += "\\&";
        line_begins = letter == '\n';
        if (letter == '\\') {
            out += "\\e";
        } else if (letter == '-') {
            out += "\\-";
        } else if (letter == '\'') {
            out += "\\(aq";
        } else if (letter == '`') {
            out += "\\(ga";
        } else if (letter == '^') {
            out += "\\(ha";
        } else if (letter == '~') {
            out += "\\(ti";
        } else if (letter >= 0x80) {
            out += fmt::format("\\[u{:04X}]", letter);
        } else {
            out += static_cast<char>(letter);
        }
    }
    return out;
}

/// The text in roff, with a new paragraph at each empty line.
std::string paragraphs(const std::string& text) {
    std::string out = ".PP\n";
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find("\n\n", begin), text.size());
        out += (begin > 0 ? ".PP\n" : "") + literal(text.substr(begin, end - begin)) + '\n';
        begin = end + 2;
    }
    return out;
}

std::string tagged(const std::string& tag, const std::string& text) {
    return ".TP\n" + tag + '\n' + literal(text) + '\n';
}

std::string option_text(const OptionFacts& option) {
    std::string tag = option.letter != '\0' ? fmt::format("\\fB\\-{}\\fR, ", option.letter) : "";
    tag += fmt::format("\\fB\\-\\-{}\\fR", literal(option.name));
    if (!option.argument.empty()) tag += fmt::format(" \\fI{}\\fR", literal(option.argument));
    if (option.several) tag += "\\|.\\|.\\|.";
    return tagged(tag, option.description + (option.value.empty() ? "" : fmt::format(" (default {})", option.value)));
}

std::string options_text(const CommandLine& line) {
    std::string out;
    for (const OptionGroup& group : option_groups(line)) {
        if (group.caption != "options") out += ".PP\n" + literal(group.caption) + ":\n";
        for (const OptionFacts& option : group.options) out += option_text(option);
    }
    return out;
}

std::string command_text(const std::string& name, const CommandLine& line) {
    std::string out = fmt::format(".SS \"crackle {}\"\n", name);
    for (const std::string& synopsis : line.synopses) out += fmt::format(".B {}\n.br\n", literal(synopsis));
    out += paragraphs(line.description);
    if (line.takes_options) out += options_text(line);
    if (!line.examples.empty()) out += ".PP\nExamples:\n";
    for (const Example& example : line.examples)
        out += fmt::format(".PP\n.nf\n.RS\n{}\n.RE\n.fi\n", literal(example.command)) +
               (example.remark.empty() ? "" : ".RS\n.RS\n" + literal(example.remark) + "\n.RE\n.RE\n");
    for (const std::string& note : line.notes) out += paragraphs(note);
    return out;
}

std::string manual_page() {
    // The page is left-aligned, so that long names of files and options neither stretch lines nor cause warnings.
    std::string out = fmt::format(
        ".\\\" Made by `crackle man`.\n.TH CRACKLE 1 \"\" \"crackle {}\" \"Virtual rock tests\"\n.ad l\n.nh\n"
        ".SH NAME\ncrackle \\- makes bonded rock specimens and tests them\n"
        ".SH SYNOPSIS\n.B crackle\n.I COMMAND\n.RI [ OPTIONS ]\n.br\n.B crackle\n.I COMMAND\n.B \\-\\-help\n.br\n"
        ".B crackle \\-\\-version\n"
        ".SH DESCRIPTION\n",
        literal(build_info::version));
    out += literal(
        "A random packing of circles becomes bonded discs, Delaunay triangles or Voronoi polygons. Platens pull or "
        "squeeze it until it breaks. The results are stress-strain curves, every single bond break, and pictures of "
        "the broken specimen. DEMseg decks can be run as well.\n");
    out += ".SH COMMANDS\n";
    for (const Command& command : commands()) {
        out += command_text(command.name, command.describe());
        if (command.studies == nullptr) continue;
        for (const Command& study : command.studies())
            out += command_text(fmt::format("{} {}", command.name, study.name), study.describe());
    }
    out += ".SH FILES\nFiles that\n.B crackle test\nwrites to its folder OUT:\n";
    for (const ResultFile& file : result_files())
        out += tagged(fmt::format("\\fI{}\\fR", literal(file.name)), file.holds);
    out += ".SH ENVIRONMENT\n";
    for (const Term& variable : variables)
        out += tagged(fmt::format("\\fB{}\\fR", literal(variable.name)), variable.text);
    out += ".SH \"EXIT STATUS\"\n";
    for (const ExitCode& code : exit_codes()) out += tagged(fmt::format("\\fB{}\\fR", code.code), code.meaning);
    return out;
}

}  // namespace

CommandLine describe_manual() {
    return {
        .synopses = {"crackle man"},
        .description =
            "Prints the manual page, with all commands and options. cmake --install installs it where man(1) finds it.",
        .examples = {{"crackle man | man -l -", "shows it"}, {"crackle man > crackle.1"}}};
}

int manual(const Invocation&) {
    print_text(manual_page());
    return exit_done;
}

}  // namespace crackle::tools
