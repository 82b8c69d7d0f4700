// SPDX-License-Identifier: GPL-3.0-or-later
// Elements shared by static pages: style, escaped text, numbers and embedded diagrams.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <string>

#include "tools/campaign/page/figures.hpp"

namespace crackle::tools {

/// The start of a page, up to its main heading and subtitle. The caller must end the page with "</body></html>".
std::string page_head(const std::string& heading, const std::string& subtitle);

/// The text with HTML's special characters escaped.
std::string html(const std::string& text);
/// A number as text for a table cell; a dash for NaN.
std::string in_cell(double value);

/// A diagram with its caption, embedded in the page as an SVG image.
std::string figure_html(const CampaignFigure& figure);

}  // namespace crackle::tools
