// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle report OUT... -o report.html`: the results of one or several tests on one self-contained page.

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/recordings/test_results.hpp"
#include "tools/campaign/page/campaign_page.hpp"
#include "tools/campaign/page/figures.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/page/report_page.hpp"

namespace crackle::tools {

namespace {

/// The page of a campaign's folder.
int report_campaign(const Invocation& given) {
    const std::filesystem::path folder = given.operands.front();
    if (given.operands.size() > 1)
        throw InputError(fmt::format("report: found {} folders, expected a campaign's by itself: {}",
                                     given.operands.size(), folder.string()));
    const std::filesystem::path output = given.values.contains("output")
                                             ? std::filesystem::path(given.values["output"].as<std::string>())
                                             : folder / "report.html";
    if (is_there(output) && !is_report_page(output))
        throw InputError(fmt::format("{}: found a file that is no report, expected a page to write; choose another -o",
                                     output.string()));
    const po::variables_map& values = given.values;
    refuse_unused("crackle report", values, "a campaign's folder", {"output", "title", "test", "measured"});
    CampaignRecord record = read_campaign(
        folder, {},
        values.contains("test") ? values["test"].as<std::vector<std::string>>() : std::vector<std::string>());
    if (values.contains("measured")) add_measured_curve(record, values["measured"].as<std::string>());
    replace_file(output, campaign_page(record, given.values["title"].as<std::string>(), output.parent_path()));
    if (!given.messages.quiet()) std::cout << output.string() << '\n';
    return exit_done;
}

}  // namespace

CommandLine describe_report() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                          "page to write; default: OUT/report.html for one test, else report.html")  //
        ("title", po::value<std::string>()->value_name("TEXT")->default_value("", ""),
         "heading; default: the test's title")  //
        ("frames", po::value<std::size_t>()->value_name("N")->default_value(default_page_frames),
         "show at most so many frames of a test, evenly chosen; start, peak and end always")  //
        ("test", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME"),
         "of a campaign: tests that are shown (default: all)")  //
        ("measured", po::value<std::string>()->value_name("FILE"),
         "of a campaign: CSV with axial_strain and axial_stress, drawn over the curves of its test");
    return {.synopses = {"crackle report OUT... [-o report.html]"},
            .description =
                "One self-contained page from the folders that `crackle test` wrote: stress-strain curves with bond "
                "breaks beneath, each specimen in motion and at start, peak and end, a table of the summaries. Opens "
                "in any browser, needs no network. Of a campaign's folder: its means, distributions, bands of curves.",
            .options = {{"options", options}},
            .operand = "OUT",
            .several_operands = true,
            .verbose = "cells, bonds and frames read, bytes written",
            .examples = {{"crackle report out/voronoi-compression"},
                         {"crackle report out/*-tension out/*-compression -o report.html --title \"Six tests\""}}};
}

int report(const Invocation& given) {
    const Arguments& folders = given.operands;
    if (folders.empty()) {
        throw InputError(
            "report: found no folder of results, expected at least one: crackle report OUT... (see --help)");
    }
    Messages& messages = given.messages;
    if (is_campaign(folders.front())) return report_campaign(given);
    refuse_unused("crackle report", given.values, "folders of tests", {"output", "title", "frames"});
    std::vector<Recording> tests;
    for (const std::string& folder : folders) {
        tests.push_back(read_test_recording(folder, given.values["frames"].as<std::size_t>()));
        report_recording(messages, tests.back());
    }
    const std::filesystem::path output = given.values.contains("output")
                                             ? std::filesystem::path(given.values["output"].as<std::string>())
                                         : folders.size() == 1 ? std::filesystem::path(folders.front()) / "report.html"
                                                               : std::filesystem::path("report.html");
    write_page(output, {given.values["title"].as<std::string>(), PageView::report}, tests, messages);
    if (!messages.quiet()) std::cout << output.string() << '\n';
    return exit_done;
}

}  // namespace crackle::tools
