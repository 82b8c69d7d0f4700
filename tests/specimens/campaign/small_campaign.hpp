// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign that takes a second, run in a temporary folder, and its table.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/campaign/point_table.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle::testing {

class SmallCampaign : public ::testing::Test {
  protected:
    CampaignOutcome run(const std::string& folder, int workers = 2, Shard shard = {}, bool companions = false) {
        CampaignOptions options;
        options.folder = folder_ / folder;
        options.workers = workers;
        options.shard = shard;
        CampaignHooks hooks;
        told_.clear();
        hooks.told = [&](const std::string& text) { told_.push_back(text); };
        return run_campaign(read_plan(folder_ / "plan.toml", companions), options, hooks);
    }
    CampaignLedger ledger(const std::string& folder) const {
        return CampaignLedger::read(ledger_file(folder_ / folder));
    }
    std::string table(const std::string& folder) const { return tests_csv(ledger(folder).results()); }

    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";
    std::vector<std::string> told_;  ///< messages of the last run
};

}  // namespace crackle::testing
