// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/campaign/page/html_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "specimens/frames/base64.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle::tools {
namespace {

constexpr double figure_width = 130.0;  // mm

constexpr const char* page_style = R"(
:root{color-scheme:light}
body{font:15px/1.5 system-ui,"DejaVu Sans",sans-serif;color:#1d2125;background:#fff;max-width:1180px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.15rem;margin:2.2rem 0 .6rem}
p.sub{color:#5b636b;margin:.2rem 0 1rem}
table{border-collapse:collapse;font-size:.9rem;width:100%}
th,td{padding:.25rem .5rem;border-bottom:1px solid #e3e6e9;text-align:right;white-space:nowrap}
th{color:#5b636b;font-weight:600}th:first-child,td:first-child,td.word,th.word{text-align:left}
td.note{color:#5b636b;font-size:.85rem;text-align:left;white-space:normal}
figure{margin:1rem 0 2rem}figcaption{color:#5b636b;font-size:.9rem;margin-top:.3rem}
figure img{width:100%;max-width:760px;height:auto}
details{margin-top:1rem}summary{cursor:pointer}
.wide{overflow-x:auto}.wrong{color:#b3261e}
)";

}  // namespace

std::string page_head(const std::string& heading, const std::string& subtitle) {
    return fmt::format(
        "<!DOCTYPE html>\n{}\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
        "data:\"><title>{}</title>"
        "<meta name=\"viewport\" content=\"width=device-width\"><style>{}</style></head><body>\n<h1>{}</h1>\n"
        "<p class=\"sub\">{}</p>\n",
        report_mark, html(heading), page_style, html(heading), html(subtitle));
}

// Pango markup has the same special characters as HTML.
std::string html(const std::string& text) { return plot::escaped(text); }

std::string in_cell(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–"; }

std::string figure_html(const CampaignFigure& figure) {
    // Each diagram is a separate image, because element ids inside one drawing also occur in the next.
    const std::string svg = plot::figure(figure.panels, "", figure_width * plot::points_of_mm, plot::Format::svg, {});
    return fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        html(figure.caption), encode_base64(std::span(reinterpret_cast<const unsigned char*>(svg.data()), svg.size())));
}

}  // namespace crackle::tools
