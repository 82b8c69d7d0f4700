// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle man`: the manual page, in the man macros of roff.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string_view>

#include "tools/command_line/command_line.hpp"
#include "tools/commands/build_info.hpp"
#include "tools/commands/commands.hpp"

namespace crackle::tools {
namespace {

struct Term {
    const char* name;
    const char* text;
};

constexpr Term result_files[] = {
    {"case.toml", "the case with every value in the open, and the hashes of its inputs; it can be run again"},
    {"curve.csv", "one row an observed step: strain, stress, energies"},
    {"events.csv", "one row a broken bonded point"},
    {"summary.json", "figures of the whole test, with their units"},
    {"frames/", "frames.pvd for ParaView: particles, contacts and cracks at start, peak, end and in between"},
    {"checkpoint", "the complete state, for --resume"},
};

constexpr Term variables[] = {
    {"NO_COLOR", "where it is set to anything: no colours"},
    {"TERM", "where it is dumb or not set: neither colours nor a progress line"},
};

/// One letter of UTF-8 at `at`, which is moved behind it.
std::uint32_t letter_at(std::string_view text, std::size_t& at) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k])); };
    const std::uint32_t first = byte(at++);
    if (first < 0x80) return first;
    const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
    std::uint32_t letter = first & (0x3FU >> more);
    for (int k = 0; k < more && at < text.size(); ++k) letter = letter << 6U | (byte(at++) & 0x3FU);
    return letter;
}

/// Text that roff shows as it is: nothing in it is a request, hyphens stay what one types.
std::string literal(std::string_view text) {
    std::string out;
    bool line_begins = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::uint32_t letter = letter_at(text, at);
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

/// Paragraphs, an empty line between them in the text.
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
    // Adjusted to the left: names of files and options stretch no line, and cause no warning where they fill one.
    std::string out = fmt::format(
        ".\\\" Made by `crackle man`.\n.TH CRACKLE 1 \"\" \"crackle {}\" \"Virtual rock tests\"\n.ad l\n.nh\n"
        ".SH NAME\ncrackle \\- makes bonded rock specimens and tests them\n"
        ".SH SYNOPSIS\n.B crackle\n.I COMMAND\n.RI [ OPTIONS ]\n.br\n.B crackle\n.I COMMAND\n.B \\-\\-help\n.br\n"
        ".B crackle \\-\\-version\n"
        ".SH DESCRIPTION\n",
        literal(build_info::version));
    out += literal(
        "A random packing of circles becomes bonded discs, Delaunay triangles or Voronoi polygons, platens pull or "
        "squeeze it until it breaks, and out come stress-strain curves, every single bond break, and pictures of the "
        "broken specimen. Decks of DEMseg run as well.\n");
    out += ".SH COMMANDS\n";
    for (const Command& command : commands()) {
        out += command_text(command.name, command.describe());
        if (command.studies == nullptr) continue;
        for (const Command& study : command.studies())
            out += command_text(fmt::format("{} {}", command.name, study.name), study.describe());
    }
    out += ".SH FILES\nWhat\n.B crackle test\nleaves in its folder OUT:\n";
    for (const Term& file : result_files) out += tagged(fmt::format("\\fI{}\\fR", literal(file.name)), file.text);
    out += ".SH ENVIRONMENT\n";
    for (const Term& variable : variables)
        out += tagged(fmt::format("\\fB{}\\fR", literal(variable.name)), variable.text);
    out += ".SH \"EXIT STATUS\"\n";
    for (const ExitCode& code : exit_codes()) out += tagged(fmt::format("\\fB{}\\fR", code.code), code.meaning);
    return out;
}

}  // namespace

CommandLine describe_manual() {
    return {.synopses = {"crackle man"},
            .description =
                "Prints the manual page of the program, all commands with all options. cmake --install puts "
                "it where man(1) looks.",
            .examples = {{"crackle man | man -l -", "reads it"}, {"crackle man > crackle.1"}}};
}

int manual(const Invocation&) {
    std::cout << manual_page();
    return exit_done;
}

}  // namespace crackle::tools
