// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle view IN...`: writes a page that shows particles, a deck run or tests.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "solver/base/errors.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/page/report_page.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

std::filesystem::path default_output(const std::vector<std::string>& inputs) {
    const std::filesystem::path input = folder_of_run(inputs.front());
    if (inputs.size() > 1) return "view.html";
    if (std::filesystem::is_directory(input)) return input / "view.html";
    return std::filesystem::path(input).replace_extension(".html");
}

}  // namespace

CommandLine describe_view() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                          "page to write; default: IN/view.html for a folder, IN with .html for a file, view.html for "
                          "several")  //
        ("title", po::value<std::string>()->value_name("TEXT")->default_value("", ""),
         "heading; default: the title of the test or the name of the input; for several inputs 'Virtual rock tests'")  //
        ("frames", po::value<std::size_t>()->value_name("N")->default_value(default_page_frames),
         "maximum number of frames shown per input, spaced evenly from the first to the last")  //
        ("seed", po::value<std::uint64_t>()->value_name("N")->default_value(1),
         "seed of the random circles of a particle file of mode 0")  //
        ("units", po::value<std::string>()->value_name("UNITS"),
         "names of the units of particle files and decks, which do not contain units: si, cgs (cm, dyn, erg) or mm-g-s "
         "(mm, uN, nJ)");
    return {.synopses = {"crackle view IN... [-o view.html]"},
            .description =
                "Writes a page that shows particles at rest or in motion. IN is a particle file (in_gm.dat, "
                "in_gm_volo.dat, ...), "
                "the folder of a deck's run (or one of its outputs), or the folder of a test. The page opens in any "
                "browser and needs no network.",
            .options = {{"options", options}},
            .operand = "IN",
            .several_operands = true,
            .choices = {{"units", unit_sets()}},
            .verbose = "numbers of cells, bonds and frames read, and of bytes written",
            .examples = {{"crackle view out/in_gm_volo.dat -o out/cells.html"},
                         {"crackle view out/slope -o out/slope.html --units cgs"},
                         {"crackle view out/pulled out/squeezed -o out/both.html"}}};
}

int view(const Invocation& given) {
    const Arguments& inputs = given.operands;
    if (inputs.empty()) {
        throw InputError(
            "view: found no input, expected a particle file or the folder of a run or test: crackle view IN "
            "(see --help)");
    }
    const po::variables_map& values = given.values;
    Messages& messages = given.messages;
    std::optional<UnitNames> units;
    if (values.contains("units")) units = units_named("view: --units", values["units"].as<std::string>());
    std::vector<Recording> recordings;
    for (const std::string& input : inputs) {
        recordings.push_back(
            read_recording(input, values["frames"].as<std::size_t>(), values["seed"].as<std::uint64_t>()));
        if (units && recordings.back().kind == Recording::Kind::test)
            throw InputError(fmt::format(
                "view: --units: found {}, a test, which is in SI units, expected particle files or runs of decks",
                input));
        report_recording(messages, recordings.back());
        for (const std::string& notice : recordings.back().notices) messages.notice(notice);
    }
    if (!values["seed"].defaulted() && std::ranges::none_of(recordings, &Recording::drawn_by_seed))
        throw without_effect("crackle view", "--seed", "inputs without random circles");
    const auto moves = [](const Recording& one) { return one.kind != Recording::Kind::particles; };
    if (!values["frames"].defaulted() && std::ranges::none_of(recordings, moves))
        throw without_effect("crackle view", "--frames", "particle files");
    const std::filesystem::path output =
        values.contains("output") ? std::filesystem::path(values["output"].as<std::string>()) : default_output(inputs);
    write_page(output, {values["title"].as<std::string>(), PageView::view, units}, recordings, messages);
    if (!messages.quiet()) print_text(output.string() + '\n');
    return exit_done;
}

}  // namespace crackle::tools
