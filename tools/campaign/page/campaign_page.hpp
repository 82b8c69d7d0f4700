// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign on one self-contained page: its table, its figures, and every test with a link to what was kept of it.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "tools/campaign/page/figures.hpp"

namespace crackle::tools {

/// The page's bytes: the same for the same ledger. @param from folder that the page will stand in, for its links
std::string campaign_page(const CampaignRecord& record, const std::string& title, const std::filesystem::path& from);

}  // namespace crackle::tools
