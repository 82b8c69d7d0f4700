// SPDX-License-Identifier: GPL-3.0-or-later
// How a command is called, as data: the words are parsed by it, and --help, the completion of shells and the manual
// page are made from it.
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

/// The words that an option understands.
struct Choices {
    std::string option;  ///< long name
    Arguments words;
};

/// An option that has an effect only beside one of others.
struct Companion {
    std::string option;  ///< long name
    Arguments one_of;    ///< long names
};

struct OptionSection {
    std::string caption;
    po::options_description options;
};

struct CommandLine {
    Arguments synopses = {};       ///< "crackle test CASE.toml -o OUT [OPTIONS]"
    std::string description = {};  ///< paragraphs, an empty line between them
    /// The command's own. --help, --quiet and --verbose come with every command that takes options.
    std::vector<OptionSection> options = {};
    bool takes_options = true;  ///< false: what follows are the words of another program
    std::string operand = {};   ///< what the words that belong to no option are, "CASE.toml"; empty: there are none
    bool several_operands = false;
    Arguments operand_words = {};  ///< understood; empty: files
    std::vector<Choices> choices = {};
    std::vector<Companion> companions = {};
    std::string verbose = {};  ///< what -v reports beside the usual
    std::vector<Example> examples = {};
    Arguments notes = {};                        ///< paragraphs that follow the examples
    Arguments (*prepared)(Arguments) = nullptr;  ///< the words as the parser takes them; absent: as they are
};

/// A command as it was called.
struct Invocation {
    po::variables_map values;  ///< of the command's own options
    Arguments operands;
    Arguments words;  ///< all that stood behind the command's name
    Messages& messages;
};

/// An option as users know it.
struct OptionFacts {
    std::string name;         ///< without the dashes
    char letter = '\0';       ///< none: 0
    std::string argument;     ///< "FILE"; empty: it takes none
    bool several = false;     ///< takes any number of arguments
    std::string value;        ///< taken where it is not given; empty: none
    std::string description;  ///< without that
    Arguments words;          ///< understood; empty: anything
};

struct OptionGroup {
    std::string caption;
    std::vector<OptionFacts> options;
};

/// All options, --help and its fellows last.
std::vector<OptionGroup> option_groups(const CommandLine& line);

/// The words between a command's name and the end of the line.
struct ParsedWords {
    po::variables_map values;
    Arguments operands;
    Loudness loudness = Loudness::usual;
    bool help = false;
};

/// @param name as typed, "crackle campaign show". @throws InputError that names what is wrong and where to look
ParsedWords parse_words(const std::string& name, const CommandLine& line, const Arguments& words);

/// An option or operand that has no effect on what is asked for. @param input "the folder of a campaign", "--check"
InputError without_effect(const std::string& name, const std::string& word, const std::string& input);

/// Refuses options that were given and that have no effect on what is asked for.
/// @param used long names of the options that have one. @throws without_effect() of the first other
void refuse_unused(const std::string& name, const po::variables_map& given, const std::string& input,
                   const Arguments& used);

/// The same of an option that stands alone: without operands, too.
void expect_alone(const std::string& name, const Invocation& given, const std::string& option);

/// The text of --help, on stdout.
void print_help(const CommandLine& line);

/// The text cut into lines of at most so many letters where words end; its own line ends stay.
Arguments wrapped(const std::string& text, std::size_t letters);

/// ", did you mean X?" of the word that is most like the one found; empty where none is.
std::string suggestion(const std::string& found, const Arguments& known);

}  // namespace crackle::tools
