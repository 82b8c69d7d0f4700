// SPDX-License-Identifier: GPL-3.0-or-later
// Runs every test of a plan that is not yet in the ledger, on the requested number of processes.
//
//   DIR/campaign.sqlite   the ledger (ledger.hpp).
//   DIR/packings/         packings; each is made only once.
//   DIR/curves/, tests/   files kept as the plan requests, named by test, point, packing and identity (kept_tests.hpp).
//   DIR/shards/I.sqlite   ledgers of shards, which run separately, for example on a cluster, until they are gathered.
//
// After an interrupt, the same command resumes; only the tests that were running are repeated.
// Tested by tests/specimens/campaign/campaign_test.cpp and outcomes_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "specimens/campaign/kept_tests.hpp"
#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan.hpp"
#include "specimens/campaign/tasks.hpp"

namespace crackle {

/// Options of a campaign.
struct CampaignOptions {
    std::filesystem::path folder;
    int workers = 1;
    Shard shard = {};
    /// Repeat tests whose case could not be tested (RowKind::verdict); tests with a system failure are always repeated.
    bool retry = false;
    bool endless = false;  ///< see TestOptions::endless
};

/// Progress of a campaign.
struct CampaignProgress {
    std::int64_t tests = 0;  ///< number of tests in this shard of the plan
    std::int64_t done = 0, gone_wrong = 0, left = 0;
    std::int64_t failures = 0;      ///< number of tests in gone_wrong with a system failure (RowKind::failure)
    double tests_per_second = 0.0;  ///< NaN before the first test has ended
    double seconds_left = 0.0;      ///< NaN before the first test has ended
};

/// Callbacks of a campaign; empty ones are skipped.
struct CampaignHooks {
    std::function<void(const CampaignProgress&)> progress;  ///< called when a test has ended
    /// Called with a sentence about a test that ended without results, or about damaged data.
    std::function<void(const std::string&)> told;
    std::function<bool()> interrupted;
};

/// Result of a call of run_campaign().
struct CampaignOutcome {
    CampaignProgress progress;
    std::int64_t run = 0;  ///< number of tests run in this call
    /// s; processor time of the tests that were run, wall-clock time of the call.
    double processor_seconds = 0.0, wall_seconds = 0.0;
    std::string failure;  ///< name and message of this call's last test with a system failure
    std::filesystem::path ledger;
    bool interrupted = false;
};

/// The ledger of a campaign's folder, or of one of its shards.
std::filesystem::path ledger_file(const std::filesystem::path& folder, const Shard& shard = {});

/// Checks that the folder is new or empty, or belongs to a campaign.
/// @throws InputError for other folders, or if an input file lies in the folder
void check_campaign_folder(const std::filesystem::path& folder, const Plan& plan);

/// Runs the plan's tests.
/// @throws InputError if the folder is in use or contains files that do not belong to a campaign; OutputError if it
/// cannot be written
CampaignOutcome run_campaign(const Plan& plan, const CampaignOptions& options, const CampaignHooks& hooks = {});

/// Result of gathering shards.
struct Gathered {
    std::int64_t shards = 0, tests = 0;  ///< tests: number of tests added
    LedgerCounts counts;
};

/// Adds the tests in the ledgers under DIR/shards to the campaign's ledger. The call may be repeated, even while shards
/// run.
/// @throws InputError if there are no shards
Gathered gather_shards(const std::filesystem::path& folder);

}  // namespace crackle
