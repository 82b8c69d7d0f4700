// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle report OUT... -o report.html`: writes the results of one or several tests to one self-contained page.

#include <fmt/format.h>

#include <filesystem>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/recordings/test_results.hpp"
#include "tools/campaign/page/campaign_page.hpp"
#include "tools/campaign/page/figures.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/page/report_page.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {

namespace {

/// Writes the page of a campaign's folder.
int report_campaign(const Invocation& given) {
    const std::filesystem::path folder = given.operands.front();
    if (given.operands.size() > 1)
        throw InputError(
            fmt::format("report: found {} folders, expected only one, since this is the folder of a campaign: {}",
                        given.operands.size(), folder.string()));
    const std::filesystem::path output =
        output_page(given.values.contains("output") ? std::filesystem::path(given.values["output"].as<std::string>())
                                                    : folder / "report.html");
    const po::variables_map& values = given.values;
    refuse_unused("crackle report", values, "a campaign's folder", {"output", "title", "test", "measured"});
    CampaignRecord record = read_campaign(
        folder, {},
        values.contains("test") ? values["test"].as<std::vector<std::string>>() : std::vector<std::string>());
    if (values.contains("measured")) add_measured_curve(record, values["measured"].as<std::string>());
    replace_file(output, campaign_page(record, given.values["title"].as<std::string>(), folder_of(output)));
    if (!given.messages.quiet()) print_text(output.string() + '\n');
    const std::string failures = notice_on_failures(record);
    if (failures.empty()) return exit_done;
    given.messages.notice(failures);
    return exit_system_fails;
}

}  // namespace

CommandLine describe_report() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                          "page to write; default: OUT/report.html for one test, otherwise report.html")  //
        ("title", po::value<std::string>()->value_name("TEXT")->default_value("", ""),
         "heading; default: the test's title")  //
        ("frames", po::value<std::size_t>()->value_name("N")->default_value(default_page_frames),
         "maximum number of frames per test, spaced evenly; start, peak and end are always included")  //
        ("test", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME"),
         "tests of a campaign to show (default: all)")  //
        ("measured", po::value<std::string>()->value_name("FILE"),
         "table with the columns axial_strain and axial_stress, with their units as in \"axial_stress (MPa)\", drawn "
         "over "
         "the curves");
    return {.synopses = {"crackle report OUT... [-o report.html]"},
            .description =
                "Writes one self-contained page from the folders that `crackle test` wrote. It shows stress-strain "
                "curves with bond breaks below, each specimen in motion and at start, peak and end, and a table of the "
                "summaries. It opens in any browser and needs no network. The page of a campaign's folder shows its "
                "means, distributions and bands of curves. Exit code 4: some tests ended with a system error and are "
                "excluded from every mean.",
            .options = {{"options", options}},
            .operand = "OUT",
            .several_operands = true,
            .verbose = "numbers of cells, bonds and frames read, and of bytes written",
            .examples = {{"crackle report out/voronoi-compression"},
                         {"crackle report out/*-tension out/*-compression -o report.html --title \"Six tests\""},
                         {"crackle report out/granite --measured laboratory.csv"}}};
}

int report(const Invocation& given) {
    const Arguments& folders = given.operands;
    if (folders.empty()) {
        throw InputError(
            "report: found no folder of results, expected at least one: crackle report OUT... (see --help)");
    }
    Messages& messages = given.messages;
    if (is_campaign(folders.front())) return report_campaign(given);
    refuse_unused("crackle report", given.values, "folders of tests", {"output", "title", "frames", "measured"});
    std::vector<Recording> tests;
    for (const std::string& folder : folders) {
        tests.push_back(read_test_recording(folder, given.values["frames"].as<std::size_t>()));
        report_recording(messages, tests.back());
    }
    const std::filesystem::path output = given.values.contains("output")
                                             ? std::filesystem::path(given.values["output"].as<std::string>())
                                         : folders.size() == 1 ? std::filesystem::path(folders.front()) / "report.html"
                                                               : std::filesystem::path("report.html");
    PageHead head{given.values["title"].as<std::string>(), PageView::report};
    if (given.values.contains("measured"))
        head.measured = measured_beside(tests, given.values["measured"].as<std::string>());
    write_page(output, head, tests, messages);
    if (!messages.quiet()) print_text(output.string() + '\n');
    return exit_done;
}

}  // namespace crackle::tools
