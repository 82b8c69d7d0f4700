// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/campaign/page/campaign_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "solver/files/read_file.hpp"
#include "specimens/frames/base64.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

constexpr double figure_width = 130.0;   // mm
constexpr std::size_t most_rows = 2000;  // of the table of tests

constexpr const char* style = R"(
:root{color-scheme:light}
body{font:15px/1.5 system-ui,"DejaVu Sans",sans-serif;color:#1d2125;background:#fff;max-width:1000px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.15rem;margin:2.2rem 0 .6rem}
p.sub{color:#5b636b;margin:.2rem 0 1rem}
table{border-collapse:collapse;font-size:.9rem;width:100%}
th,td{padding:.25rem .6rem;border-bottom:1px solid #e3e6e9;text-align:right;white-space:nowrap}
th{color:#5b636b;font-weight:600}th:first-child,td:first-child,td.word,th.word{text-align:left}
td.note{color:#5b636b;font-size:.85rem;text-align:left;white-space:normal}
figure{margin:1rem 0 2rem}figcaption{color:#5b636b;font-size:.9rem;margin-top:.3rem}
figure img{width:100%;max-width:760px;height:auto}
details{margin-top:1rem}summary{cursor:pointer}
.wide{overflow-x:auto}.wrong{color:#b3261e}
)";

/// Pango's markup takes the letters that HTML does.
std::string html(const std::string& text) { return plot::escaped(text); }

std::string in_cell(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–"; }

std::string points_table(const CampaignRecord& record) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>test</th><th "
        "class=\"word\">figure</th><th>packings</th><th>mean</th>"
        "<th>deviation</th><th>cv, %</th><th>95 % of the mean</th></tr></thead><tbody>\n";
    for (const PointSummary& point : record.points) {
        bool first = true;
        for (const std::string& figure : record.figures) {
            const MeanFigure& mean = point.figures.at(figure);
            const std::string unit = unit_of_figure(figure, point.area_units);
            text += fmt::format(
                "<tr><td>{}</td><td "
                "class=\"word\">{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                first ? html(point.axes.empty() ? point.test : fmt::format("{}, {}", point.test, point.at())) : "",
                html(spoken_figure(figure)), unit.empty() ? "" : ", " + unit, mean.count, in_cell(mean.mean),
                in_cell(mean.deviation),
                std::isfinite(mean.variation()) ? fmt::format("{:.1f}", 100.0 * std::abs(mean.variation())) : "–",
                std::isfinite(mean.low) ? fmt::format("{} to {}", in_cell(mean.low), in_cell(mean.high)) : "–");
            first = false;
            if (const auto bias = point.biases.find(figure); bias != point.biases.end())
                text += fmt::format("<tr><td></td><td class=\"note\" colspan=\"6\">{}</td></tr>\n",
                                    html(verdict_on(mean, bias->second)));
        }
        if (point.gone_wrong > 0)
            text +=
                fmt::format("<tr><td></td><td class=\"note wrong\" colspan=\"6\">{} of {} have gone wrong</td></tr>\n",
                            point.gone_wrong, point.planned);
        if (point.unfailed > 0)
            text += fmt::format(
                "<tr><td></td><td class=\"note\" colspan=\"6\">{} did not fail by "
                "loading.max_axial_strain: they have no strength</td></tr>\n",
                point.unfailed);
    }
    return text + "</tbody></table></div>\n";
}

/// What was kept of a test, as a link.
std::string link_to(const CampaignRecord& record, const std::string& identity, const fs::path& from) {
    const fs::path test = record.folder / "tests" / identity;
    for (const fs::path& kept :
         {test / "report.html", test / "summary.json", record.folder / "curves" / (identity + ".csv")}) {
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
            "<p class=\"sub\">The first {} of {}; <code>crackle campaign show DIR --tests</code> has all.</p>\n",
            most_rows, results.rows.size());
    return text;
}

}  // namespace

std::string campaign_page(const CampaignRecord& record, const std::string& title, const fs::path& from) {
    const std::string heading = html(title.empty() ? record.title : title);
    std::string text = fmt::format(
        "<!DOCTYPE html>\n{}\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>"
        "<meta name=\"viewport\" content=\"width=device-width\"><style>{}</style></head><body>\n<h1>{}</h1>\n"
        "<p class=\"sub\">{} of {} tests done{}, {:.3g} s of a processor</p>\n",
        report_mark, heading, style, heading, record.counts.done, record.counts.tests,
        record.counts.gone_wrong > 0 ? fmt::format(", {} gone wrong", record.counts.gone_wrong) : "",
        record.counts.processor_seconds);
    text += "<h2>What the packings say</h2>\n" + points_table(record);
    text += "<h2>Figures</h2>\n";
    for (const CampaignFigure& figure : campaign_figures(record)) {
        text += "<figure>";
        // An image each: names within one drawing are those of the next, too.
        const std::string svg =
            plot::figure(figure.panels, "", figure_width * plot::points_of_mm, plot::Format::svg, {});
        text += fmt::format(
            "<img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
            html(figure.caption),
            encode_base64(std::span(reinterpret_cast<const unsigned char*>(svg.data()), svg.size())));
    }
    text += "<details><summary>All tests</summary>\n" + tests_table(record, from) + "</details>\n";
    return text + "</body></html>\n";
}

}  // namespace crackle::tools
