// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle campaign show DIR`: means, scatter and intervals of a campaign's figures.
// Tested by tests/tools/campaign/campaign_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/campaign.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

std::string printed(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

void print_point(const PointSummary& point, const std::vector<std::string>& figures) {
    fmt::print("\n{}{}{}: {} of {} done{}\n", point.test, point.axes.empty() ? "" : ", ", point.at(), point.done,
               counted(point.planned, "packing"),
               point.gone_wrong > 0 ? fmt::format(", {} gone wrong", point.gone_wrong) : "");
    if (point.unfailed > 0)
        fmt::print(
            "  notice: {} did not fail by loading.max_axial_strain: they have no strength and are in no mean of "
            "it\n",
            point.unfailed);
    fmt::print("  {:<26}{:>4}{:>12}{:>12}{:>8}{:>26}\n", "figure", "n", "mean", "deviation", "cv %", "95 % interval");
    for (const std::string& figure : figures) {
        const MeanFigure& mean = point.figures.at(figure);
        const std::string unit = unit_of_figure(figure, point.area_units);
        fmt::print("  {:<26}{:>4}{:>12}{:>12}{:>8}{:>26}\n",
                   fmt::format("{}{}{}", figure, unit.empty() ? "" : " ", unit), mean.count, printed(mean.mean),
                   printed(mean.deviation),
                   std::isfinite(mean.variation()) ? fmt::format("{:.1f}", 100.0 * std::abs(mean.variation())) : "-",
                   std::isfinite(mean.low) ? fmt::format("{:.4g} to {:.4g}", mean.low, mean.high) : "-");
        const auto bias = point.biases.find(figure);
        if (bias != point.biases.end()) fmt::print("  {:<26}{}\n", "", verdict_on(mean, bias->second));
    }
}

}  // namespace

CommandLine describe_campaign_show() {
    po::options_description options;
    options.add_options()(
        "figure", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
        "figures of summary.json (default: youngs_modulus poissons_ratio peak_stress peak_strain)")  //
        ("all", "all figures")                                                                       //
        ("csv", "the same as CSV")                                                                   //
        ("tests", "as CSV, a row a test: axes, seed, variant, state and all figures")                //
        ("wrong", "tests that have gone wrong, and why");
    return {
        .synopses = {"crackle campaign show DIR [OPTIONS]"},
        .description =
            "Prints what the packings of each point of a campaign's plan say: mean, standard deviation, coefficient "
            "of variation and the 95 % interval of the mean (bootstrap over packings); with companions "
            "(`crackle campaign --verify`) also by how much step and rate shift it. May be called while the "
            "campaign runs.",
        .options = {{"options", options}},
        .operand = "DIR",
        .examples = {{"crackle campaign show out/granite"},
                     {"crackle campaign show out/granite --figure peak_stress failed_at"},
                     {"crackle campaign show out/granite --tests > tests.csv"}}};
}

int campaign_show(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty()) throw InputError("crackle campaign show: found no DIR, expected a campaign's folder");
    for (const char* table : {"wrong", "tests"}) {
        if (values.contains(table)) refuse_unused("crackle campaign show", values, std::string("--") + table, {table});
    }
    if (values.contains("all")) refuse_unused("crackle campaign show", values, "--all", {"all", "csv"});
    const CampaignLedger ledger = CampaignLedger::read(ledger_file(given.operands.front()));
    if (values.contains("wrong")) {
        const LedgerTable wrong = ledger.query(
            "SELECT DISTINCT test.identity, test.state, test.message FROM plan JOIN test USING(identity) WHERE "
            "test.state <> 'done' ORDER BY plan.row");
        for (const auto& row : wrong.rows) {
            const auto* message = std::get_if<std::string>(&row[2]);
            fmt::print("{} {}: {}\n", std::get<std::string>(row[0]), std::get<std::string>(row[1]),
                       message != nullptr ? *message : "");
        }
        return exit_done;
    }
    const LedgerTable results = ledger.results();
    if (values.contains("tests")) {
        std::cout << tests_csv(results);
        return exit_done;
    }
    const std::vector<std::string> known = numeric_figures(results);
    std::vector<std::string> figures;
    if (values.contains("all")) {
        figures = known;
    } else if (values.contains("figure")) {
        figures = values["figure"].as<std::vector<std::string>>();
    } else {
        figures = usual_figures(results);
    }
    const std::vector<PointSummary> points = summarise(results, figures);
    if (values.contains("csv")) {
        std::cout << points_csv(points, figures);
        return exit_done;
    }
    const LedgerCounts counts = ledger.counts();
    fmt::print("{}: {} of {} done, {} gone wrong{}; {:.3g} s of a processor\n", ledger.meta("title"), counts.done,
               counted(counts.tests, "test"), counts.gone_wrong, counts.gone_wrong > 0 ? " (--wrong says why)" : "",
               counts.processor_seconds);
    for (const PointSummary& point : points) print_point(point, figures);
    return exit_done;
}

}  // namespace crackle::tools
