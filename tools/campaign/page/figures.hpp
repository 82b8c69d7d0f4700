// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a campaign's folder: curves of its packings as bands, and what they say of each figure.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/point_table.hpp"
#include "tools/plot/campaign_panels.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::tools {

/// What is read of a campaign.
struct CampaignRecord {
    explicit CampaignRecord(const std::filesystem::path& campaign) : folder(campaign), kept(campaign) {}

    std::filesystem::path folder;
    KeptTests kept;
    std::string title;
    LedgerTable results;
    LedgerCounts counts;
    std::vector<std::string> figures;                                  ///< those that are drawn
    std::vector<PointSummary> points;                                  ///< with these
    std::map<std::string, std::vector<plot::LabelledCurve>> measured;  ///< drawn over the curves of a test, by its name
};

/// Whether a folder is a campaign's.
bool is_campaign(const std::filesystem::path& folder);

/// @param figures of summary.json; empty: the usual ones that there are
/// @param tests of the plan; empty: all
CampaignRecord read_campaign(const std::filesystem::path& folder, const std::vector<std::string>& figures = {},
                             const std::vector<std::string>& tests = {});

/// Lays a measured curve over those of the record's tests, which must be of one kind. @throws InputError
void add_measured_curve(CampaignRecord& record, const std::filesystem::path& file);

/// "peak stress" of peak_stress, as titles have it.
std::string spoken_figure(const std::string& figure);

/// Of one kind of test: bands of curves where they were kept, distributions of each figure, and each figure over every
/// axis that has several values.
struct CampaignFigure {
    std::string part;  ///< "curve", "axes" or "scatter"
    std::string test;  ///< of the plan
    std::string caption;
    std::vector<plot::Panel> panels;
};
std::vector<CampaignFigure> campaign_figures(const CampaignRecord& record);

}  // namespace crackle::tools
