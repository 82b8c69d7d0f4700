// SPDX-License-Identifier: GPL-3.0-or-later
// Description of a command's options and operands as data. It is used for parsing, --help, shell completion and the
// manual page.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <boost/program_options/variables_map.hpp>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "tools/terminal/messages.hpp"

namespace crackle::tools {

namespace po = boost::program_options;

using Arguments = std::vector<std::string>;

struct Example {
    std::string command, remark = {};
};

/// The words that an option accepts.
struct Choices {
    std::string option;  ///< long name
    Arguments words;
};

/// An option that has an effect only together with at least one of several others.
struct Companion {
    std::string option;  ///< its long name
    Arguments one_of;    ///< long names of the other options
};

struct OptionSection {
    std::string caption;
    po::options_description options;
};

struct CommandLine {
    Arguments synopses = {};       ///< for example "crackle test CASE.toml -o OUT [OPTIONS]"
    std::string description = {};  ///< paragraphs, separated by empty lines
    /// Options of the command itself. --help, --quiet and --verbose are added automatically if the command takes
    /// options.
    std::vector<OptionSection> options = {};
    bool takes_options = true;  ///< false if the words that follow are passed to another program
    std::string operand =
        {};  ///< name of the operand in texts, for example "CASE.toml"; empty if the command takes none
    bool several_operands = false;
    Arguments operand_words = {};  ///< accepted operands; empty if operands are file names
    std::vector<Choices> choices = {};
    std::vector<Companion> companions = {};
    std::string verbose = {};  ///< what -v prints in addition
    std::vector<Example> examples = {};
    Arguments notes = {};                        ///< paragraphs after the examples
    Arguments (*prepared)(Arguments) = nullptr;  ///< converts the words before parsing; null if this is not needed
};

/// A command as invoked by the user.
struct Invocation {
    po::variables_map values;  ///< values of the command's own options
    Arguments operands;
    Arguments words;  ///< all words after the command's name
    Messages& messages;
};

/// An option as shown to the user.
struct OptionFacts {
    std::string name;         ///< long name without the leading dashes
    char letter = '\0';       ///< one-letter name, or 0
    std::string argument;     ///< name of the argument, such as "FILE"; empty if the option takes none
    bool several = false;     ///< whether it takes any number of arguments
    std::string value;        ///< default value, or empty
    std::string description;  ///< description without the default value
    Arguments words;          ///< accepted words; empty if any text is accepted
};

struct OptionGroup {
    std::string caption;
    std::vector<OptionFacts> options;
};

/// All options; the common ones (--help, --quiet, --verbose) come last.
std::vector<OptionGroup> option_groups(const CommandLine& line);

/// Result of parsing the words after a command's name.
struct ParsedWords {
    po::variables_map values;
    Arguments operands;
    Loudness loudness = Loudness::usual;
    bool help = false;
};

/// @param name the command as the user types it, for example "crackle campaign show" @throws InputError that names the
/// invalid word and states where to find help
ParsedWords parse_words(const std::string& name, const CommandLine& line, const Arguments& words);

/// Error for an option or operand that has no effect for a given kind of input. @param input description of it, for
/// example "the folder of a campaign" or "--check"
InputError without_effect(const std::string& name, const std::string& word, const std::string& input);

/// Refuses options that were given but have no effect.
/// @param used long names of the options that have an effect @throws InputError, made by
/// without_effect(), for the first given option that is not in `used`
void refuse_unused(const std::string& name, const po::variables_map& given, const std::string& input,
                   const Arguments& used);

/// Refuses operands and other options next to an option that must be used alone.
void expect_alone(const std::string& name, const Invocation& given, const std::string& option);

/// Prints the help text to stdout.
void print_help(const CommandLine& line);

/// The text wrapped at spaces to lines of at most `letters` characters; existing newlines are kept.
Arguments wrapped(const std::string& text, std::size_t letters);

/// ", did you mean X?" with the known word most similar to `found`; empty if none is similar.
std::string suggestion(const std::string& found, const Arguments& known);

}  // namespace crackle::tools
