// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/campaign/page/campaign_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/files/read_file.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/page/html_page.hpp"
#include "tools/plot/campaign_panels.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows = 2000;  // largest number of rows in the table of tests

std::string points_table(const CampaignRecord& record) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>test</th><th "
        "class=\"word\">figure</th><th>mean ± error</th><th>95 % interval of the mean</th>"
        "<th>deviation</th><th>deviation, %</th><th>packings</th></tr></thead><tbody>\n";
    for (const PointSummary& point : record.points) {
        bool first = true;
        for (const std::string& figure : record.figures) {
            const MeanFigure& mean = point.figures.at(figure);
            const plot::Unit unit = plot::figure_unit(std::abs(mean.mean), unit_of_figure(figure, point.area_units));
            const auto number = [&](double value) { return in_cell(value / unit.factor); };
            text += fmt::format(
                "<tr><td>{}</td><td "
                "class=\"word\">{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                first ? html(point.axes.empty() ? point.test : fmt::format("{}, {}", point.test, point.at())) : "",
                html(spoken_figure(figure)), unit.name.empty() ? "" : ", " + unit.name,
                std::isfinite(mean.standard_error)
                    ? fmt::format("{} ± {:.2g}", number(mean.mean), mean.standard_error / unit.factor)
                    : number(mean.mean),
                std::isfinite(mean.low) ? fmt::format("{} to {}", number(mean.low), number(mean.high)) : "–",
                number(mean.deviation),
                std::isfinite(mean.variation()) ? fmt::format("{:.1f}", 100.0 * std::abs(mean.variation())) : "–",
                mean.count);
            first = false;
            if (const auto bias = point.biases.find(figure); bias != point.biases.end())
                text += fmt::format("<tr><td></td><td class=\"note\" colspan=\"6\">{}</td></tr>\n",
                                    html(verdict_on(mean, bias->second)));
        }
        if (point.gone_wrong > 0)
            text += fmt::format(
                "<tr><td></td><td class=\"note wrong\" colspan=\"6\">{} of {} ended without a result</td></tr>\n",
                point.gone_wrong, point.planned);
        if (point.invalid > 0)
            text += fmt::format(
                "<tr><td></td><td class=\"note\" colspan=\"6\">{} of {} not valid for the kind of test</td></tr>\n",
                point.invalid, point.done);
        if (point.unfailed > 0)
            text += fmt::format(
                "<tr><td></td><td class=\"note\" colspan=\"6\">{} did not fail before loading.max_axial_strain, so "
                "they have no strength</td></tr>\n",
                point.unfailed);
    }
    return text + "</tbody></table></div>\n";
}

/// Link to the files kept for a test.
std::string link_to(const CampaignRecord& record, const std::string& identity, const fs::path& from) {
    std::vector<fs::path> files;
    if (const auto test = record.kept.folder(identity)) files = {*test / "report.html", *test / "summary.json"};
    if (const auto curve = record.kept.curve(identity)) files.push_back(*curve);
    for (const fs::path& kept : files) {
        if (!is_file(kept)) continue;
        const std::string way = fs::absolute(kept)
                                    .lexically_normal()
                                    .lexically_proximate(fs::absolute(from).lexically_normal())
                                    .generic_string();
        return fmt::format("<a href=\"{}\">{}</a>", html(way), html(kept.filename().string()));
    }
    return "";
}

std::string tests_table(const CampaignRecord& record, const fs::path& from) {
    const LedgerTable& results = record.results;
    const auto place = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(results.columns.begin(), results.columns.end(), name) -
                                        results.columns.begin());
    };
    const std::size_t test = place("test"), seed = place("seed"), variant = place("variant"), state = place("state"),
                      identity = place("identity");
    std::vector<std::size_t> shown;
    for (std::size_t k = test + 1; k < seed; ++k) shown.push_back(k);
    for (const std::string& figure : record.figures) shown.push_back(place(figure));
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>test</th><th>seed</th><th class=\"word\">variant</th>"
        "<th class=\"word\">state</th>";
    for (const std::size_t k : shown) text += fmt::format("<th>{}</th>", html(spoken_figure(results.columns[k])));
    text += "<th class=\"word\">kept</th></tr></thead><tbody>\n";
    const auto cell = [&](const std::vector<LedgerCell>& row, std::size_t k) {
        if (const auto* value = std::get_if<double>(&row[k])) return in_cell(*value);
        if (const auto* word = std::get_if<std::string>(&row[k])) return html(*word);
        return std::string("–");
    };
    for (std::size_t number = 0; number < std::min(results.rows.size(), most_rows); ++number) {
        const std::vector<LedgerCell>& row = results.rows[number];
        text += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"word\">{}</td><td class=\"word\">{}</td>",
                            cell(row, test), cell(row, seed), cell(row, variant), cell(row, state));
        for (const std::size_t k : shown) text += fmt::format("<td>{}</td>", cell(row, k));
        text += fmt::format("<td class=\"word\">{}</td></tr>\n",
                            link_to(record, std::get<std::string>(row[identity]), from));
    }
    text += "</tbody></table></div>\n";
    if (results.rows.size() > most_rows)
        text += fmt::format(
            "<p class=\"sub\">The first {} of {}; <code>crackle campaign show DIR --tests</code> prints all.</p>\n",
            most_rows, results.rows.size());
    return text;
}

}  // namespace

std::string campaign_page(const CampaignRecord& record, const std::string& title, const fs::path& from) {
    std::string text = page_head(
        title.empty() ? record.title : title,
        fmt::format(
            "{} of {} done{}, {:.3g} s of processor time", record.counts.done, counted(record.counts.tests, "test"),
            record.counts.gone_wrong > 0 ? ", " + spoken_wrong(record.counts.gone_wrong, record.counts.failures) : "",
            record.counts.processor_seconds));
    text += "<h2>Means over packings</h2>\n" + points_table(record);
    text += "<h2>Figures</h2>\n";
    for (const CampaignFigure& figure : campaign_figures(record)) text += figure_html(figure);
    text += "<details><summary>All tests</summary>\n" + tests_table(record, from) + "</details>\n";
    return text + "</body></html>\n";
}

}  // namespace crackle::tools
