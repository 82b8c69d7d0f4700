// SPDX-License-Identifier: GPL-3.0-or-later
// The self-contained page of a campaign: its table, its diagrams, and all tests with links to the files kept for them.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "tools/campaign/page/figures.hpp"

namespace crackle::tools {

/// The page as HTML; identical results give identical bytes. @param from folder in which the page will be placed, for
/// relative links
std::string campaign_page(const CampaignRecord& record, const std::string& title, const std::filesystem::path& from);

}  // namespace crackle::tools
