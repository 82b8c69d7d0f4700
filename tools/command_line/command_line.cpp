// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/command_line/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/positional_options.hpp>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iostream>
#include <typeinfo>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/utf8.hpp"
#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

constexpr const char* operand_name = "operand";  // internal name used by the parser, not an option for users
constexpr std::size_t help_columns = 100;

po::options_description common_options(const CommandLine& line) {
    po::options_description options;
    options.add_options()("quiet,q", "print only errors and the result")                           //
        ("verbose,v", ("print more" + (line.verbose.empty() ? "" : ": " + line.verbose)).c_str())  //
        ("help,h", "print this text");
    return options;
}

/// Splits "FILE (=in_gm.dat)" into "FILE" and the default value "in_gm.dat".
std::pair<std::string, std::string> split_argument(const std::string& name) {
    const std::size_t at = name.find(" (=");
    if (at == std::string::npos) return {name, ""};
    return {name.substr(0, at), name.substr(at + 3, name.size() - at - 4)};
}

OptionGroup facts_of(const OptionSection& section, const std::vector<Choices>& choices) {
    OptionGroup group{section.caption, {}};
    for (const auto& option : section.options.options()) {
        OptionFacts facts;
        facts.name = option->long_name();
        const std::string letter = option->canonical_display_name(po::command_line_style::allow_dash_for_short);
        if (letter.size() == 2 && letter[0] == '-' && letter[1] != '-') facts.letter = letter[1];
        facts.description = option->description();
        const unsigned most = option->semantic()->max_tokens();
        if (most > 0) {
            std::tie(facts.argument, facts.value) = split_argument(option->semantic()->name());
            facts.several = most > 1;
        }
        for (const Choices& known : choices) {
            if (known.option == facts.name) facts.words = known.words;
        }
        group.options.push_back(std::move(facts));
    }
    return group;
}

std::string padded(const std::string& text, std::size_t letters) {
    return text + std::string(std::max(count_letters(text), letters) - count_letters(text), ' ');
}

void print_options(const CommandLine& line) {
    std::size_t widest = 0;
    std::vector<OptionGroup> groups = option_groups(line);
    const auto term = [](const OptionFacts& option) {
        return fmt::format("  {}--{}{}{}", option.letter != '\0' ? fmt::format("-{}, ", option.letter) : "    ",
                           option.name, option.argument.empty() ? "" : " " + option.argument,
                           option.several ? "..." : "");
    };
    for (const OptionGroup& group : groups) {
        for (const OptionFacts& option : group.options) widest = std::max(widest, count_letters(term(option)) + 2);
    }
    for (const OptionGroup& group : groups) {
        std::cout << '\n' << styled(group.caption + ':', Style::heading, Stream::out) << '\n';
        for (const OptionFacts& option : group.options) {
            const std::string text =
                option.description + (option.value.empty() ? "" : fmt::format(" (default {})", option.value));
            std::string before = term(option);
            for (const std::string& part : wrapped(text, help_columns - widest)) {
                std::cout << padded(before, widest) << part << '\n';
                before.clear();
            }
        }
    }
}

void print_examples(const std::vector<Example>& examples) {
    if (examples.empty()) return;
    std::cout << '\n' << styled("examples:", Style::heading, Stream::out) << '\n';
    std::size_t widest = 0;
    for (const Example& example : examples) {
        if (!example.remark.empty()) widest = std::max(widest, count_letters(example.command));
    }
    for (const Example& example : examples) {
        std::cout << "  "
                  << (example.remark.empty() ? example.command : padded(example.command, widest + 2) + example.remark)
                  << '\n';
    }
}

/// Smallest number of character changes that turn one word into the other.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

/// End of an error message that describes the values of an option; empty if any text is accepted.
std::string kind_of_value(const po::option_description& option) {
    const auto* const typed = dynamic_cast<const po::typed_value_base*>(option.semantic().get());
    if (typed == nullptr) return {};
    const std::type_info& type = typed->value_type();
    if (type == typeid(double)) return ", expected a number";
    const std::initializer_list<const std::type_info*> whole{
        &typeid(int),         &typeid(std::int64_t),     &typeid(std::uint64_t),
        &typeid(std::size_t), &typeid(std::vector<int>), &typeid(std::vector<std::int64_t>)};
    const auto is_it = [&](const std::type_info* one) { return *one == type; };
    return std::ranges::any_of(whole, is_it) ? ", expected a whole number" : "";
}

/// The parser's error, reworded for this program.
std::string complaint(const po::error& error, const CommandLine& line) {
    if (const auto* const invalid = dynamic_cast<const po::invalid_option_value*>(&error)) {
        std::string expected;
        for (const OptionSection& section : line.options) {
            for (const auto& option : section.options.options())
                if ("--" + option->long_name() == invalid->get_option_name()) expected = kind_of_value(*option);
        }
        return error.what() + expected;
    }
    const auto* const unknown = dynamic_cast<const po::unknown_option*>(&error);
    if (unknown == nullptr) return error.what();
    Arguments known;
    for (const OptionGroup& group : option_groups(line)) {
        for (const OptionFacts& option : group.options) known.push_back("--" + option.name);
    }
    return error.what() + suggestion(unknown->get_option_name(), known);
}

bool is_given(const po::variables_map& values, const std::string& option) {
    return values.contains(option) && !values[option].defaulted();
}

void expect_companions(const std::string& name, const CommandLine& line, const po::variables_map& values) {
    for (const Companion& one : line.companions) {
        if (!is_given(values, one.option)) continue;
        if (std::ranges::any_of(one.one_of, [&](const std::string& other) { return is_given(values, other); }))
            continue;
        const std::string others = "--" + fmt::format("{}", fmt::join(one.one_of, " or --"));
        throw InputError(fmt::format("{0}: --{1}: found without {2}, but has no effect alone; leave it out, or add {2}",
                                     name, one.option, others));
    }
}

}  // namespace

InputError without_effect(const std::string& name, const std::string& word, const std::string& input) {
    return InputError(fmt::format("{}: {}: found with {}, but has no effect there; leave it out", name, word, input));
}

void refuse_unused(const std::string& name, const po::variables_map& given, const std::string& input,
                   const Arguments& used) {
    for (const auto& [option, value] : given) {
        const bool common = option == operand_name || option == "quiet" || option == "verbose" || option == "help";
        if (common || value.defaulted() || std::ranges::find(used, option) != used.end()) continue;
        throw without_effect(name, "--" + option, input);
    }
}

void expect_alone(const std::string& name, const Invocation& given, const std::string& option) {
    refuse_unused(name, given.values, "--" + option, {option});
    if (!given.operands.empty()) throw without_effect(name, given.operands.front(), "--" + option);
}

std::string suggestion(const std::string& found, const Arguments& known) {
    std::string best;
    std::size_t fewest = found.size() / 3 + 2;  // words that need this many changes or more count as unrelated
    for (const std::string& word : known) {
        const std::size_t changes = distance(found, word);
        if (changes < fewest) {
            fewest = changes;
            best = word;
        }
    }
    return best.empty() ? "" : fmt::format(", did you mean {}?", best);
}

Arguments wrapped(const std::string& text, std::size_t letters) {
    Arguments lines;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string line;
        std::size_t at = begin;
        while (at < end) {
            const std::size_t blank = std::min(text.find(' ', at), end);
            const std::string word = text.substr(at, blank - at);
            if (!line.empty() && count_letters(line) + 1 + count_letters(word) > letters) {
                lines.push_back(std::move(line));
                line.clear();
            }
            line += (line.empty() ? "" : " ") + word;
            at = blank + 1;
        }
        lines.push_back(std::move(line));
        begin = end + 1;
    }
    return lines;
}

std::vector<OptionGroup> option_groups(const CommandLine& line) {
    std::vector<OptionGroup> groups;
    groups.reserve(line.options.size() + 1);
    for (const OptionSection& section : line.options) groups.push_back(facts_of(section, line.choices));
    const OptionGroup common = facts_of({"", common_options(line)}, {});
    if (groups.empty()) groups.push_back({"options", {}});
    auto& first = groups.front().options;
    first.insert(first.end(), common.options.begin(), common.options.end());
    return groups;
}

ParsedWords parse_words(const std::string& name, const CommandLine& line, const Arguments& words) {
    po::options_description all;
    for (const OptionSection& section : line.options) all.add(section.options);
    all.add(common_options(line));
    all.add_options()(operand_name, po::value<Arguments>());
    po::positional_options_description places;
    places.add(operand_name, -1);
    ParsedWords parsed;
    try {
        const Arguments prepared = line.prepared != nullptr ? line.prepared(words) : words;
        po::store(po::command_line_parser(prepared).options(all).positional(places).run(), parsed.values);
        po::notify(parsed.values);
    } catch (const po::error& error) {
        throw InputError(fmt::format("{}: {} (see {} --help)", name, complaint(error, line), name));
    }
    parsed.help = parsed.values.contains("help");
    const bool quiet = parsed.values.contains("quiet"), verbose = parsed.values.contains("verbose");
    if (parsed.help) return parsed;
    expect_companions(name, line, parsed.values);
    if (quiet && verbose) throw InputError(name + ": found --quiet and --verbose, expected only one of them");
    parsed.loudness = quiet ? Loudness::quiet : verbose ? Loudness::verbose : Loudness::usual;
    if (parsed.values.contains(operand_name)) parsed.operands = parsed.values[operand_name].as<Arguments>();
    const std::size_t most = line.operand.empty() ? 0 : line.several_operands ? parsed.operands.size() : 1;
    if (parsed.operands.size() > most) {
        throw InputError(fmt::format("{}: found '{}', expected {} (see {} --help)", name, parsed.operands[most],
                                     most == 0 ? "options alone" : "one " + line.operand, name));
    }
    return parsed;
}

void print_help(const CommandLine& line) {
    std::string before = "usage: ";
    for (const std::string& synopsis : line.synopses) {
        std::cout << (before == "usage: " ? styled("usage:", Style::heading, Stream::out) + ' ' : before) << synopsis
                  << '\n';
        before = "       ";
    }
    std::cout << '\n';
    for (const std::string& text : wrapped(line.description, help_columns)) std::cout << text << '\n';
    if (line.takes_options) print_options(line);
    print_examples(line.examples);
    for (const std::string& note : line.notes) {
        std::cout << '\n';
        for (const std::string& text : wrapped(note, help_columns)) std::cout << text << '\n';
    }
}

}  // namespace crackle::tools
