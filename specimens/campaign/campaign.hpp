// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a plan: every test of it that the ledger does not have, on as many processes as there are processors.
//
//   DIR/campaign.sqlite   the ledger (ledger.hpp)
//   DIR/packings/         packings, each made once
//   DIR/curves/, tests/   what the plan keeps of its tests, named by test, point, packing and identity (kept_name())
//   DIR/shards/I.sqlite   ledgers of shares that ran by themselves, on a cluster say, until they are gathered
//
// Stopped at any moment, the same command goes on; at most the tests that were at work are run again.
// Tested by tests/specimens/campaign/campaign_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan.hpp"

namespace crackle {

/// One of so many shares of a plan's tests: packings are dealt out in turn, single tests where they are too few.
struct Shard {
    int number = 1, of = 1;
    bool whole() const { return of == 1; }
};

/// "confined-pressure=10000000-packing3-1b6f7a6a471c": the name of what is kept of a row's test. A point of many axes
/// is named by its number, from 1.
std::string kept_name(const Plan& plan, const PlanRow& row, const std::string& identity);

/// What has been kept of a campaign's tests, or begun, when this was made: found by identity whatever the plan called
/// them then. Names that are an identity alone are those of earlier versions.
class KeptTests {
  public:
    explicit KeptTests(const std::filesystem::path& folder);

    /// The name in use; none where nothing is there.
    std::optional<std::string> name(const std::string& identity) const;
    /// The curve of a test, alone or among its files.
    std::optional<std::filesystem::path> curve(const std::string& identity) const;
    /// Of a test of which all files were kept.
    std::optional<std::filesystem::path> folder(const std::string& identity) const;

  private:
    std::map<std::string, std::filesystem::path> curves_, folders_;  // by the first digits of the identity
};

struct CampaignOptions {
    std::filesystem::path folder;
    int workers = 1;
    Shard shard = {};
    bool retry = false;    ///< those that have gone wrong are run again
    bool endless = false;  ///< as TestOptions::endless
};

struct CampaignProgress {
    std::int64_t tests = 0;  ///< of this share of the plan
    std::int64_t done = 0, gone_wrong = 0, left = 0;
    double tests_per_second = 0.0;  ///< not a number before the first
    double seconds_left = 0.0;      ///< likewise
};

struct CampaignHooks {
    std::function<void(const CampaignProgress&)> progress;  ///< whenever a test has ended
    std::function<void(const std::string&)> told;           ///< a sentence on one that has gone wrong
    std::function<bool()> interrupted;
};

struct CampaignOutcome {
    CampaignProgress progress;
    std::int64_t run = 0;                                ///< in this call
    double processor_seconds = 0.0, wall_seconds = 0.0;  ///< of the tests; of the call
    std::filesystem::path ledger;
    bool interrupted = false;
};

/// The ledger of a campaign's folder, or of a share of it.
std::filesystem::path ledger_file(const std::filesystem::path& folder, const Shard& shard = {});

/// A folder is taken that is new, empty, or a campaign's. @throws InputError for another
void check_campaign_folder(const std::filesystem::path& folder);

/// @throws InputError if the folder holds something else or is in use; OutputError if it cannot be written
CampaignOutcome run_campaign(const Plan& plan, const CampaignOptions& options, const CampaignHooks& hooks = {});

struct Gathered {
    std::int64_t shards = 0, tests = 0;  ///< tests: added
    LedgerCounts counts;
};

/// Adds what the shares in DIR/shards have run to the ledger. Any number of times, in any order, while they run.
/// @throws InputError if there is none
Gathered gather_shards(const std::filesystem::path& folder);

}  // namespace crackle
