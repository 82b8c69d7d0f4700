// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/calibrate/calibration_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "specimens/calibration/outcome_files.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/page/figures.hpp"
#include "tools/campaign/page/html_page.hpp"
#include "tools/plot/campaign_panels.hpp"

namespace crackle::tools {
namespace {

bool in_area_units(const Rock& rock, const CalibrationOutcome& outcome, std::size_t target) {
    return rock.case_of(rock.targets[target].test, outcome.values()).area_units();
}

std::string targets_table(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>target</th><th>value</th><th>mean ± error</th>"
        "<th>scatter</th><th>difference, %</th><th>tolerance, %</th><th class=\"word\"></th></tr></thead><tbody>\n";
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const Target& target = rock.targets[k];
        const ReachedTarget& reached = outcome.targets[k];
        const plot::Unit unit = plot::figure_unit(target.value, target.unit(in_area_units(rock, outcome, k)));
        text += fmt::format(
            "<tr><td>{} of {}{}</td><td>{}</td><td>{} ± {:.2g}</td><td>{:.2g}</td><td>{:+.1f}</td><td>{:.1f}</td>"
            "<td class=\"word{}\">{}</td></tr>\n",
            html(spoken_figure(target.quantity())), html(target.source(rock.tests)),
            unit.name.empty() ? "" : ", " + unit.name, in_cell(target.value / unit.factor),
            in_cell(reached.fresh.mean / unit.factor), reached.fresh.standard_error / unit.factor,
            reached.fresh.deviation / unit.factor, 100.0 * reached.off, 100.0 * reached.limit,
            reached.reached() ? "" : " wrong", name_of(reached.verdict));
    }
    return text + "</tbody></table></div>\n";
}

std::string keys_table(const Rock& rock, const CalibrationOutcome& outcome) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>key</th><th>value</th><th>95 % interval</th><th>bounds</th>"
        "</tr></thead><tbody>\n";
    for (std::size_t k = 0; k < rock.free.size(); ++k) {
        const FoundKey& key = outcome.keys[k];
        text += fmt::format("<tr><td>{}</td><td>{:.5g}</td><td>{}</td><td>{} to {}{}</td></tr>\n",
                            html(rock.free[k].name()), key.value,
                            key.determined ? fmt::format("{} to {}", in_cell(key.low), in_cell(key.high))
                                           : "not determined by the targets",
                            in_cell(rock.free[k].from), in_cell(rock.free[k].to), key.at_bound ? " (at a bound)" : "");
    }
    return text + "</tbody></table></div>\n";
}

/// Diagram of one target against another, with the points tried, the compromises, the target values, and the values
/// reached by fresh packings. Empty if there are fewer than two targets.
std::optional<CampaignFigure> targets_plane(const Rock& rock, const CalibrationOutcome& outcome) {
    if (rock.targets.size() < 2) return std::nullopt;
    // The last two targets are used, since moduli are usually listed first and are met exactly.
    const std::size_t x = rock.targets.size() - 2, y = rock.targets.size() - 1;
    const auto with_interval = [](double mean, double low, double high) {
        return plot::Sample{"", {low, high}, mean, low, high};
    };
    std::vector<plot::Series> all;
    plot::Series tried{"tried", {}, {}, false}, frontier{"compromises", {}, {}, true}, target{"target", {}, {}, false},
        reached{"reached by fresh packings", {}, {}, false};
    for (const std::vector<double>& means : outcome.tried_means) {
        // Points are not shown if a mean differs from its target by more than this factor. A search may start so far
        // from the targets that the other points could not be distinguished.
        constexpr double near = 2.5;
        const auto off = [&](std::size_t k) { return std::abs(std::log(means[k] / rock.targets[k].value)); };
        if (!(std::max(off(x), off(y)) < std::log(near))) continue;
        tried.x.push_back(means[x]);
        tried.samples.push_back({"", {means[y]}, means[y], std::nan(""), std::nan("")});
    }
    for (const FrontierPoint& point : outcome.frontier) {
        const MeanFigure& mean = point.figures[y];
        frontier.x.push_back(point.figures[x].mean);
        frontier.samples.push_back(with_interval(mean.mean, mean.low, mean.high));
    }
    target.x.push_back(rock.targets[x].value);
    target.samples.push_back(with_interval(rock.targets[y].value,
                                           rock.targets[y].value * (1.0 - rock.targets[y].tolerance),
                                           rock.targets[y].value * (1.0 + rock.targets[y].tolerance)));
    const MeanFigure& fresh = outcome.targets[y].fresh;
    reached.x.push_back(outcome.targets[x].fresh.mean);
    reached.samples.push_back(with_interval(fresh.mean, fresh.low, fresh.high));
    for (const plot::Series& series : {tried, frontier, target, reached})
        if (!series.x.empty()) all.push_back(series);
    const auto name = [&](std::size_t k) {
        return fmt::format("{} of {}", spoken_figure(rock.targets[k].quantity()), rock.targets[k].source(rock.tests));
    };
    const std::string unit = rock.targets[x].unit(in_area_units(rock, outcome, x));
    return CampaignFigure{
        "axes",
        "",
        fmt::format("{} against {}: means over the fitted packings at all points tried, the target with its tolerance, "
                    "and the mean over {} fresh packings with its 95 % interval",
                    name(y), name(x), outcome.targets[y].fresh.count),
        {plot::over_axis(name(x), unit, name(y), rock.targets[y].unit(in_area_units(rock, outcome, y)), all)}};
}

}  // namespace

std::string calibration_page(const Rock& rock, const CalibrationOutcome& outcome, const std::filesystem::path& folder) {
    const auto reached = std::count_if(outcome.targets.begin(), outcome.targets.end(),
                                       [](const ReachedTarget& one) { return one.reached(); });
    std::string text = page_head(rock.title, fmt::format("{} of {} reached on {}; {}, {:.3g} s of processor time, {}",
                                                         reached, counted(outcome.targets.size(), "target"),
                                                         counted(outcome.targets.front().fresh.count, "fresh packing"),
                                                         counted(outcome.tests, "test"), outcome.processor_seconds,
                                                         counted(outcome.linear_solves, "linear solve")));
    text += "<h2>Targets</h2>\n" + targets_table(rock, outcome);
    text += "<h2>Keys</h2>\n" + keys_table(rock, outcome);
    const std::string remarks = calibration_remarks(rock, outcome);
    if (!remarks.empty()) text += "<pre style=\"white-space:pre-wrap\">" + html(remarks) + "</pre>\n";
    text += "<h2>Figures</h2>\n";
    if (const auto plane = targets_plane(rock, outcome)) text += figure_html(*plane);
    CampaignRecord record = read_campaign(folder / "fresh");
    // Each axis has a single value, the calibrated one, so it need not appear in diagrams.
    for (PointSummary& point : record.points) point.axes.clear();
    for (const MeasuredCurve& curve : rock.curves)
        record.measured[rock.tests[curve.test].name].push_back({"measured", curve.points});
    for (const CampaignFigure& figure : campaign_figures(record)) text += figure_html(figure);
    return text + "</body></html>\n";
}

}  // namespace crackle::tools
