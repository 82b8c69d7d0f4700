// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle campaign show DIR`: prints means, scatter and intervals of a campaign's results.
// Tested by tests/tools/campaign/campaign_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/campaign.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

std::string printed(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

void print_point(const PointSummary& point, const std::vector<std::string>& figures) {
    print_out("\n{}{}{}: {} of {} done{}\n", point.test, point.axes.empty() ? "" : ", ", point.at(), point.done,
              counted(point.planned, "packing"),
              point.gone_wrong > 0 ? ", " + spoken_wrong(point.gone_wrong, point.failures) : "");
    if (point.unfailed > 0)
        print_out(
            "  notice: {} did not fail before loading.max_axial_strain, so they are excluded from the mean strength\n",
            point.unfailed);
    if (point.invalid > 0)
        print_out("  notice: {} of {} {} not valid for {} kind; summary.json states why\n", point.invalid, point.done,
                  point.invalid == 1 ? "is" : "are", point.done == 1 ? "its" : "their");
    print_out("  {:<26}{:>4}{:>12}{:>12}{:>26}{:>12}{:>8}\n", "figure", "n", "mean", "error", "95 % interval",
              "deviation", "cv %");
    for (const std::string& figure : figures) {
        const MeanFigure& mean = point.figures.at(figure);
        const SpokenUnit unit = spoken_unit(mean.mean, mean.count > 0 ? unit_of_figure(figure, point.area_units) : "");
        const auto shown = [&](double value) { return printed(value / unit.factor); };
        print_out("  {:<26}{:>4}{:>12}{:>12}{:>26}{:>12}{:>8}\n",
                  fmt::format("{}{}{}", figure, unit.name.empty() ? "" : " ", unit.name), mean.count, shown(mean.mean),
                  shown(mean.standard_error),
                  std::isfinite(mean.low) ? fmt::format("{} to {}", shown(mean.low), shown(mean.high)) : "-",
                  shown(mean.deviation),
                  std::isfinite(mean.variation()) ? fmt::format("{:.1f}", 100.0 * std::abs(mean.variation())) : "-");
        const auto bias = point.biases.find(figure);
        if (bias != point.biases.end()) print_out("  {:<26}{}\n", "", verdict_on(mean, bias->second));
    }
}

}  // namespace

CommandLine describe_campaign_show() {
    po::options_description options;
    options.add_options()(
        "figure", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
        "keys of summary.json to print (default: youngs_modulus poissons_ratio peak_stress peak_strain)")  //
        ("all", "print all numeric keys")                                                                  //
        ("csv", "print the statistics as CSV")                                                             //
        ("tests", "print CSV with one row per test: axes, seed, variant, state and all results")           //
        ("wrong", "print the tests that ended without a result, and the reason for each");
    return {
        .synopses = {"crackle campaign show DIR [OPTIONS]"},
        .description =
            "Prints statistics over the packings of each point of a campaign's plan: mean, its standard error and 95 % "
            "interval (bootstrap over packings; Student's t for fewer than 8), and the standard deviation between "
            "packings. After `crackle "
            "campaign --verify` it also prints how much the time step and the rate shift the mean. It can be "
            "called while the campaign runs. Exit code 4: some tests ended with a system error and are excluded "
            "from all means; `crackle campaign` repeats them.",
        .options = {{"options", options}},
        .operand = "DIR",
        .examples = {{"crackle campaign show out/granite"},
                     {"crackle campaign show out/granite --figure peak_stress bonds_broken"},
                     {"crackle campaign show out/granite --tests > tests.csv"}}};
}

int campaign_show(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty())
        throw InputError("crackle campaign show: argument DIR is missing, expected a campaign's folder");
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
            const auto text = [&](std::size_t k) {
                const auto* found = std::get_if<std::string>(&row[k]);
                return found != nullptr ? *found : "";
            };
            print_out("{} {}: {}\n", text(0), text(1), text(2));
        }
        return exit_done;
    }
    const LedgerTable results = ledger.results();
    if (values.contains("tests")) {
        print_text(tests_csv(results));
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
    const LedgerCounts counts = ledger.counts();
    const int code = counts.failures > 0 ? exit_system_fails : exit_done;
    if (values.contains("csv")) {
        print_text(points_csv(points, figures));
        return code;
    }
    print_out("{}: {} of {} done, {}{}; {:.3g} s of processor time\n", ledger.meta("title"), counts.done,
              counted(counts.tests, "test"), spoken_wrong(counts.gone_wrong, counts.failures),
              counts.gone_wrong > 0 ? " (--wrong prints why)" : "", counts.processor_seconds);
    for (const PointSummary& point : points) print_point(point, figures);
    return code;
}

}  // namespace crackle::tools
