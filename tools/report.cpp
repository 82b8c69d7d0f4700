// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle report OUT... -o report.html`: the results of one or several tests on one self-contained page.

#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>

#include "solver/errors.hpp"
#include "tools/commands.hpp"
#include "tools/report_page.hpp"

namespace crackle::tools {
namespace {

namespace po = boost::program_options;

constexpr const char* report_examples = R"(
examples:
  crackle report out/voronoi-compression
  crackle report out/*-tension out/*-compression -o report.html --title "Six tests of one packing"
)";

}  // namespace

int report(const Arguments& arguments) {
    po::options_description options("options");
    options.add_options()("help,h", "show this")  //
        ("output,o", po::value<std::string>(),
         "page to write; default: OUT/report.html for one test, else report.html")  //
        ("title", po::value<std::string>()->default_value(""), "heading; default: the test's title");
    po::options_description all;
    all.add(options).add_options()("folder", po::value<std::vector<std::string>>());
    po::positional_options_description places;
    places.add("folder", -1);
    po::variables_map given;
    po::store(po::command_line_parser(arguments).options(all).positional(places).run(), given);
    po::notify(given);
    if (given.contains("help")) {
        std::cout << "usage: crackle report OUT... [-o report.html]\n\nOne self-contained page from the folders that "
                     "`crackle test` wrote: stress-strain "
                     "curves with bond\nbreaks beneath, a table of the summaries, each specimen at start, peak and "
                     "end. Opens in any browser,\nneeds no "
                     "network.\n\n"
                  << options << report_examples;
        return exit_done;
    }
    if (!given.contains("folder")) {
        throw InputError(
            "report: found no folder of results, expected at least one: crackle report OUT... (see --help)");
    }
    std::vector<std::filesystem::path> folders;
    for (const std::string& folder : given["folder"].as<std::vector<std::string>>()) folders.emplace_back(folder);
    const std::filesystem::path output = given.contains("output")
                                             ? std::filesystem::path(given["output"].as<std::string>())
                                         : folders.size() == 1 ? folders.front() / "report.html"
                                                               : std::filesystem::path("report.html");
    write_report(folders, output, given["title"].as<std::string>());
    std::cout << output.string() << '\n';
    return exit_done;
}

}  // namespace crackle::tools
