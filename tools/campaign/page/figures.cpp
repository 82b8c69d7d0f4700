// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/campaign/page/figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/recordings/curve_points.hpp"
#include "specimens/recordings/test_results.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/page/labels.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using namespace plot;

constexpr std::size_t most_bundles = 6;  // largest number of bands or lines in one diagram

std::size_t place_of(const LedgerTable& table, const std::string& column) {
    const auto at = std::find(table.columns.begin(), table.columns.end(), column);
    return static_cast<std::size_t>(at - table.columns.begin());
}

std::string text_of(const std::vector<LedgerCell>& row, std::size_t column) {
    if (column >= row.size()) return "";
    const auto* text = std::get_if<std::string>(&row[column]);
    return text != nullptr ? *text : "";
}

Sample sample_of(const PointSummary& point, const std::string& figure, const std::string& label) {
    const MeanFigure& mean = point.figures.at(figure);
    return {label, point.values.at(figure), mean.mean, mean.low, mean.high};
}

std::optional<CurveBundle> bundle_of(const CampaignRecord& record, const PointSummary& point) {
    CurveBundle bundle;
    bundle.label = point.axes.empty() ? point.test : spoken_point(point);
    bundle.stress_unit = point.area_units ? "Pa" : "N/m";
    const std::size_t identity = place_of(record.results, "identity"), kind = place_of(record.results, "kind"),
                      state = place_of(record.results, "state");
    for (const std::size_t number : point.rows) {
        if (text_of(record.results.rows[number], state) != row_done) continue;
        const std::optional<KeptTests::Curve> kept =
            record.kept.read_curve(text_of(record.results.rows[number], identity));
        if (!kept) continue;
        CurvePoints curve = strain_and_stress(number_table(kept->file, kept->text));
        if (curve.empty()) continue;
        bundle.curves.push_back(std::move(curve));
        bundle.kind = text_of(record.results.rows[number], kind);
    }
    if (bundle.curves.empty()) return std::nullopt;
    return bundle;
}

/// Plots a result against one axis of the plan, with one line for each combination of values on the other axes.
std::optional<Panel> panel_over(const std::vector<const PointSummary*>& points, const std::string& axis,
                                const std::string& figure) {
    std::map<std::string, Series> all;
    for (const PointSummary* point : points) {
        const auto at = std::ranges::find(point->axes, axis, &std::pair<std::string, LedgerCell>::first);
        const auto* x = at == point->axes.end() ? nullptr : std::get_if<double>(&at->second);
        if (x == nullptr) continue;
        const std::string others = spoken_point(*point, axis);
        Series& series = all[others];
        series.label = others;
        series.x.push_back(*x);
        series.samples.push_back(sample_of(*point, figure, ""));
    }
    // Points of a [design] differ in several axes at once, so they are drawn as a single cloud without lines.
    const bool cloud = all.size() > most_bundles ||
                       std::all_of(all.begin(), all.end(), [](const auto& one) { return one.second.x.size() < 2; });
    std::vector<Series> listed;
    if (cloud) listed.push_back({"", {}, {}, false});
    for (auto& [label, series] : all) {
        if (!cloud) {
            if (series.x.size() > 1) listed.push_back(std::move(series));
            continue;
        }
        listed[0].x.insert(listed[0].x.end(), series.x.begin(), series.x.end());
        for (Sample& sample : series.samples) listed[0].samples.push_back(std::move(sample));
    }
    if (listed.empty() || listed[0].x.size() < 2) return std::nullopt;
    const bool area = points.front()->area_units;
    const AxisLabel label = axis_label(axis, area);
    return over_axis(label.name, label.unit, spoken_figure(figure), unit_of_figure(figure, area), listed);
}

using Points = std::vector<const PointSummary*>;

void require_like_scale(const LabelledCurve& measured, const std::vector<CurveBundle>& bundles) {
    double largest_strain = 0.0, largest_stress = 0.0;
    for (const CurveBundle& bundle : bundles) {
        for (const auto& curve : bundle.curves) {
            for (const auto& [strain, stress] : curve) {
                largest_strain = std::max(largest_strain, strain);
                largest_stress = std::max(largest_stress, stress);
            }
        }
    }
    crackle::require_like_scale(measured.label, measured.points, largest_strain, largest_stress,
                                bundles.front().stress_unit);
}

/// Stress-strain curves of the points of one test. The figure has no panels if the campaign kept no curves.
CampaignFigure curve_figure(const CampaignRecord& record, const std::string& test, const Points& points) {
    CampaignFigure figure{"curve", test, "", {}};
    if (!is_folder(record.folder / "curves") && !is_folder(record.folder / "tests")) return figure;
    std::vector<CurveBundle> bundles;
    for (std::size_t k = 0; k < points.size() && bundles.size() < most_bundles; ++k)
        if (std::optional<CurveBundle> bundle = bundle_of(record, *points[k])) bundles.push_back(*std::move(bundle));
    if (bundles.empty()) return figure;
    const auto counts = std::minmax_element(
        bundles.begin(), bundles.end(), [](const auto& a, const auto& b) { return a.curves.size() < b.curves.size(); });
    const std::size_t fewest = counts.first->curves.size(), most = counts.second->curves.size();
    const std::string some = points.size() > bundles.size() ? fmt::format("; only the first {} of {} points are shown",
                                                                          bundles.size(), points.size())
                                                            : "";
    figure.caption =
        fmt::format("{}: the median of {}, and the range of the middle 80 %{}", test,
                    fewest == most ? counted(most, "packing") : fmt::format("{} to {} packings", fewest, most), some);
    const auto found = record.measured.find(test);
    const std::vector<LabelledCurve> measured =
        found == record.measured.end() ? std::vector<LabelledCurve>() : found->second;
    for (const LabelledCurve& curve : measured) require_like_scale(curve, bundles);
    figure.panels.push_back(curve_bands(bundles, measured));
    return figure;
}

/// Plots each result of one test against an axis of the plan.
CampaignFigure axis_figure(const CampaignRecord& record, const std::string& test, const Points& points,
                           const std::string& axis) {
    CampaignFigure figure{"axes",
                          test,
                          fmt::format("{} against {}: means with 95 % intervals, and every packing", test,
                                      axis_label(axis, points.front()->area_units).name),
                          {}};
    for (const std::string& name : record.figures)
        if (std::optional<Panel> panel = panel_over(points, axis, name)) figure.panels.push_back(*std::move(panel));
    return figure;
}

/// Plots the scatter of each result of one test over the packings.
CampaignFigure scatter_figure(const CampaignRecord& record, const std::string& test, const Points& points) {
    constexpr std::size_t most_samples = 12;
    CampaignFigure figure{
        "scatter", test, fmt::format("{}: every packing, and the mean with its 95 % interval", test), {}};
    for (const std::string& name : record.figures) {
        std::vector<Sample> samples;
        for (std::size_t k = 0; k < points.size() && k < most_samples; ++k)
            samples.push_back(sample_of(*points[k], name, points[k]->axes.empty() ? test : spoken_point(*points[k])));
        if (std::any_of(samples.begin(), samples.end(), [](const Sample& s) { return !s.values.empty(); }))
            figure.panels.push_back(
                distributions(spoken_figure(name), unit_of_figure(name, points.front()->area_units), samples));
    }
    return figure;
}

}  // namespace

std::string spoken_figure(const std::string& figure) {
    std::string text = figure;
    std::replace(text.begin(), text.end(), '_', ' ');
    if (text == "youngs modulus") return "Young's modulus E";
    if (text == "poissons ratio") return "Poisson's ratio ν";
    return text;
}

bool is_campaign(const fs::path& folder) { return is_folder(folder) && is_file(ledger_file(folder)); }

CampaignRecord read_campaign(const fs::path& folder, const std::vector<std::string>& figures,
                             const std::vector<std::string>& tests) {
    const CampaignLedger ledger = CampaignLedger::read(ledger_file(folder));
    CampaignRecord record(folder, ledger);
    record.title = ledger.meta("title");
    record.results = ledger.results();
    record.counts = ledger.counts();
    record.figures = figures.empty() ? usual_figures(record.results) : figures;
    record.points = summarise(record.results, record.figures);
    std::set<std::string> names;
    for (const PointSummary& point : record.points) names.insert(point.test);
    for (const std::string& test : tests)
        if (!names.contains(test))
            throw InputError(fmt::format("{}: found no test '{:.60}', expected one of {}", folder.string(), test,
                                         fmt::join(names, ", ")));
    if (!tests.empty()) {
        std::erase_if(record.points, [&](const PointSummary& point) {
            return std::find(tests.begin(), tests.end(), point.test) == tests.end();
        });
    }
    if (record.counts.done == 0)
        throw InputError(fmt::format("{}: found no completed test, expected at least one; `crackle campaign` runs them",
                                     folder.string()));
    return record;
}

std::string notice_on_failures(const CampaignRecord& record) {
    if (record.counts.failures == 0) return "";
    return fmt::format(
        "{} ended with a system error and {} excluded from all means; run `crackle campaign` again to repeat {}",
        counted(record.counts.failures, "test"), record.counts.failures > 1 ? "are" : "is",
        record.counts.failures > 1 ? "them" : "it");
}

void add_measured_curve(CampaignRecord& record, const fs::path& file) {
    const LabelledCurve curve = labelled_curve(file);
    std::set<std::string> kinds;
    for (const PointSummary& point : record.points) kinds.insert(point.test);
    if (kinds.size() > 1)
        throw InputError(fmt::format(
            "{}: found tests {}, expected a single one to compare with the measured curve; choose it with --test",
            file.string(), fmt::join(kinds, ", ")));
    record.measured[*kinds.begin()].push_back(curve);
}

std::vector<CampaignFigure> campaign_figures(const CampaignRecord& record) {
    std::vector<std::string> kinds;
    for (const PointSummary& point : record.points)
        if (std::find(kinds.begin(), kinds.end(), point.test) == kinds.end()) kinds.push_back(point.test);
    std::vector<CampaignFigure> all;
    const auto add = [&](CampaignFigure figure) {
        if (!figure.panels.empty()) all.push_back(std::move(figure));
    };
    for (const std::string& kind : kinds) {
        Points points;
        for (const PointSummary& point : record.points)
            if (point.test == kind) points.push_back(&point);
        add(curve_figure(record, kind, points));
        for (const auto& [key, value] : points.front()->axes)
            if (std::holds_alternative<double>(value)) add(axis_figure(record, kind, points, key));
        add(scatter_figure(record, kind, points));
    }
    if (kinds.size() == 1) return all;
    for (CampaignFigure& figure : all)
        for (Panel& panel : figure.panels) panel.title = figure.test;
    return all;
}

}  // namespace crackle::tools
