// SPDX-License-Identifier: GPL-3.0-or-later
// Diagrams of the results in a campaign's folder: stress-strain curves of its packings as bands, and the values of each
// numeric result. In identifiers, a «figure» is such a result, named by its key in summary.json.
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

/// Data read from a campaign's folder.
struct CampaignRecord {
    CampaignRecord(const std::filesystem::path& campaign, const CampaignLedger& ledger)
        : folder(campaign), kept(campaign, ledger.kept_hashes()) {}

    std::filesystem::path folder;
    KeptTests kept;
    std::string title;
    LedgerTable results;
    LedgerCounts counts;
    std::vector<std::string> figures;  ///< names of the results to draw
    std::vector<PointSummary> points;  ///< points of the plan, with the statistics of `figures`
    /// Measured curves to draw over the curves of a test, by the test's name.
    std::map<std::string, std::vector<LabelledCurve>> measured;
};

/// Whether a folder contains a campaign.
bool is_campaign(const std::filesystem::path& folder);

/// Reads a campaign's folder. @param figures keys of summary.json; if empty, the default keys that are present
/// @param tests names of tests in the plan; if empty, all tests @throws InputError if a row has changed since it was
/// written
CampaignRecord read_campaign(const std::filesystem::path& folder, const std::vector<std::string>& figures = {},
                             const std::vector<std::string>& tests = {});

/// A sentence about tests that ended with a system error and are excluded from the means; empty if there are none.
std::string notice_on_failures(const CampaignRecord& record);

/// Adds a measured curve to draw over the curves of the record's only test. @throws InputError if the record has
/// several tests
void add_measured_curve(CampaignRecord& record, const std::filesystem::path& file);

/// Name of a result in titles, for example "peak stress" for peak_stress.
std::string spoken_figure(const std::string& figure);

/// Diagrams of one kind for one test of the plan: bands of curves, the distribution of each result, or each result
/// against one axis that has several values.
struct CampaignFigure {
    std::string part;  ///< value of --what that selects these diagrams: "curve", "axes" or "scatter"
    std::string test;  ///< name of the test in the plan
    std::string caption;
    std::vector<plot::Panel> panels;
};
/// @throws InputError if a curve file differs from what its test wrote
std::vector<CampaignFigure> campaign_figures(const CampaignRecord& record);

}  // namespace crackle::tools
