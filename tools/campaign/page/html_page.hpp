// SPDX-License-Identifier: GPL-3.0-or-later
// What static pages share: their style, letters, numbers, and figures within the page.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <string>

#include "tools/campaign/page/figures.hpp"

namespace crackle::tools {

/// Up to the first heading and the line beneath it; the page ends with "</body></html>".
std::string page_head(const std::string& heading, const std::string& subtitle);

/// Text with the letters escaped that HTML takes for its own.
std::string html(const std::string& text);
/// A number in a cell; a dash for what is none.
std::string in_cell(double value);

/// Drawn as SVG within the page.
std::string figure_html(const CampaignFigure& figure);

}  // namespace crackle::tools
