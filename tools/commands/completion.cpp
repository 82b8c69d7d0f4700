// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle completion SHELL`: prints a script that makes a shell complete commands, options, option arguments and file
// names.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "solver/base/errors.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/build_info.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

/// A command or subcommand, with the words that can follow it.
struct Completed {
    std::string name;  ///< for example "mesh" or "campaign show"
    std::string summary;
    CommandLine line;
    Arguments studies;
};

std::vector<Completed> completed_commands() {
    std::vector<Completed> all;
    for (const Command& command : commands()) {
        Completed one{command.name, command.summary, command.describe(), {}};
        std::vector<Completed> studies;
        if (command.studies != nullptr) {
            for (const Command& study : command.studies()) {
                one.studies.emplace_back(study.name);
                studies.push_back({one.name + ' ' + study.name, study.summary, study.describe(), {}});
            }
        }
        all.push_back(std::move(one));
        for (Completed& study : studies) all.push_back(std::move(study));
    }
    return all;
}

Arguments command_names() {
    Arguments names;
    for (const Command& command : commands()) names.emplace_back(command.name);
    return names;
}

std::vector<OptionFacts> options_of(const CommandLine& line) {
    std::vector<OptionFacts> all;
    if (!line.takes_options) return all;
    for (const OptionGroup& group : option_groups(line))
        all.insert(all.end(), group.options.begin(), group.options.end());
    return all;
}

std::string pattern_of(const std::string& command, const OptionFacts& option) {
    std::string pattern = fmt::format("'{} --{}'", command, option.name);
    if (option.letter != '\0') pattern += fmt::format(" | '{} -{}'", command, option.letter);
    return pattern;
}

// Names contain neither quotes nor blanks, so they can be placed between quotes unchanged.
constexpr const char* bash_script =
    R"(# Completion of crackle {version} for {shell}, made by `crackle completion {shell}`.
{prelude}_crackle() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} called=${{COMP_WORDS[1]}}
    local IFS=$' \n' option= words= k=
    COMPREPLY=()
    if [ "$word" = = ]; then  # --option=: the line is cut there, too
        word=
    elif [ "$before" = = ]; then
        before=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    for ((k = COMP_CWORD - 1; k > 1; --k)); do  # whose arguments may be going on
        case ${{COMP_WORDS[k]}} in -*) option=${{COMP_WORDS[k]}}; break ;; esac
    done
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W '{commands}' -- "$word"))
        return
    fi
    case $called in
{studies}    esac
    case $word in
        -*)
            case $called in
{options}            esac ;;
        *)
            case "$called $before" in
{arguments}                *)
                    case "$called $option" in
{lists}                    esac ;;
            esac ;;
    esac
    if [ -n "$words" ]; then
        COMPREPLY=($(compgen -W "$words" -- "$word"))
    else
        IFS=$'\n'
        compopt -o filenames 2>/dev/null
        COMPREPLY=($(compgen -f -- "$word"))
    fi
}}
complete -F _crackle crackle
)";

std::string joined(const Arguments& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::string bash_completion(const std::string& shell) {
    std::string studies, arguments, lists, options;
    for (const Completed& command : completed_commands()) {
        if (!command.studies.empty()) {
            // A file or an option may be given instead of a subcommand.
            studies += fmt::format(
                "        {0})\n"
                "            if [ \"$COMP_CWORD\" -eq 2 ] && [ \"${{word#-}}\" = \"$word\" ]; then\n"
                "                COMPREPLY=($(compgen -f -W '{1}' -- \"$word\"))\n"
                "                return\n"
                "            fi\n"
                "            case ${{COMP_WORDS[2]}} in {2}) called=\"{0} ${{COMP_WORDS[2]}}\" ;; esac ;;\n",
                command.name, joined(command.studies), fmt::join(command.studies, "|"));
        }
        Arguments names;
        for (const OptionFacts& option : options_of(command.line)) {
            names.push_back("--" + option.name);
            if (option.words.empty()) continue;
            const std::string words = fmt::format(") words='{}' ;;\n", joined(option.words));
            if (option.several) lists += "                        " + pattern_of(command.name, option) + words;
            if (!option.several) arguments += "                " + pattern_of(command.name, option) + words;
        }
        options += fmt::format("                '{}') words='{}' ;;\n", command.name, joined(names));
        if (!command.line.operand_words.empty()) {
            lists += fmt::format("                        '{} ') words='{}' ;;\n", command.name,
                                 joined(command.line.operand_words));
        }
    }
    Arguments first = command_names();
    first.insert(first.end(), {"--help", "--version"});
    const std::string prelude = shell == "zsh" ? "autoload -U +X bashcompinit && bashcompinit\n" : "";
    return fmt::format(bash_script, fmt::arg("version", build_info::version), fmt::arg("shell", shell),
                       fmt::arg("prelude", prelude), fmt::arg("commands", joined(first)), fmt::arg("studies", studies),
                       fmt::arg("arguments", arguments), fmt::arg("lists", lists), fmt::arg("options", options));
}

/// The text in single quotes, for the fish shell.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char letter : text) {
        if (letter == '\'' || letter == '\\') out += '\\';
        out += letter;
    }
    return out + '\'';
}

std::string first_sentence(const std::string& text) { return text.substr(0, text.find_first_of(";:(\n")); }

std::string fish_completion() {
    std::string text = fmt::format(
        "# Completion of crackle {} for fish, made by `crackle completion fish`.\n"
        "function __crackle_calls\n"
        "    set -l words (commandline -opc)\n"
        "    test \"$words[2..(math 1 + (count $argv))]\" = \"$argv\"\n"
        "end\n"
        "complete -c crackle -n 'test (count (commandline -opc)) -eq 1' -f -l help -d 'commands'\n"
        "complete -c crackle -n 'test (count (commandline -opc)) -eq 1' -f -l version\n",
        build_info::version);
    for (const Completed& command : completed_commands()) {
        const std::size_t blank = command.name.find(' ');
        const std::string before = blank == std::string::npos ? "" : command.name.substr(0, blank);
        const std::string name = blank == std::string::npos ? command.name : command.name.substr(blank + 1);
        text += fmt::format("complete -c crackle -n 'test (count (commandline -opc)) -eq {}{}' -f -a {} -d {}\n",
                            before.empty() ? 1 : 2, before.empty() ? "" : "; and __crackle_calls " + before, name,
                            quoted(command.summary));
        for (const OptionFacts& option : options_of(command.line)) {
            text += fmt::format("complete -c crackle -n '__crackle_calls {}' -l {}", command.name, option.name);
            if (option.letter != '\0') text += fmt::format(" -s {}", option.letter);
            if (!option.argument.empty()) text += " -r";
            if (!option.words.empty()) text += fmt::format(" -f -a {}", quoted(joined(option.words)));
            text += fmt::format(" -d {}\n", quoted(first_sentence(option.description)));
        }
        if (!command.line.operand_words.empty()) {
            text += fmt::format("complete -c crackle -n '__crackle_calls {}' -f -a {}\n", command.name,
                                quoted(joined(command.line.operand_words)));
        }
    }
    return text;
}

}  // namespace

CommandLine describe_completion() {
    return {.synopses = {"crackle completion bash|zsh|fish"},
            .description =
                "Prints a script with which the shell completes commands, options, the words that options "
                "take, and files. cmake --install installs it where shells find it.",
            .operand = "SHELL",
            .operand_words = {"bash", "zsh", "fish"},
            .examples = {{"source <(crackle completion bash)", "in this shell"},
                         {"crackle completion bash >> ~/.bash_completion", "in all future sessions of bash"},
                         {"crackle completion zsh >> ~/.zshrc", "in all future sessions of zsh"},
                         {"crackle completion fish > ~/.config/fish/completions/crackle.fish"}}};
}

int completion(const Invocation& given) {
    const std::string shell = given.operands.empty() ? "nothing" : given.operands.front();
    if (shell == "fish") {
        print_text(fish_completion());
    } else if (shell == "bash" || shell == "zsh") {
        print_text(bash_completion(shell));
    } else {
        throw InputError(fmt::format("crackle completion: found {}, expected bash, zsh or fish", shell));
    }
    return exit_done;
}

}  // namespace crackle::tools
