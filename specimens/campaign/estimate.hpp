// SPDX-License-Identifier: GPL-3.0-or-later
// How long a plan will take before it has begun, and the script that has a cluster run it.
// Tested by tests/specimens/campaign/estimate_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

struct KindEstimate {
    std::string test;
    std::int64_t rows = 0;  ///< of the plan
    double seconds = 0.0;   ///< of a processor, one test
    bool measured = false;  ///< mean of those that have been run; else by --check of the first and last point
    std::vector<std::string> warnings;  ///< of that check
};

struct PlanEstimate {
    std::vector<KindEstimate> kinds;
    double seconds = 0.0;  ///< of a processor, all rows
};

/// @param ledger of earlier runs of the plan, absent: none. @throws as check_test()
PlanEstimate estimate_plan(const Plan& plan, const CampaignLedger* ledger, const TestHooks& hooks = {});

struct BatchRequest {
    std::filesystem::path program, plan, folder;  ///< absolute
    int shards = 1, workers = 1;
    double seconds = 0.0;        ///< of a processor, all rows
    double largest_share = 1.0;  ///< of the work, of one share
    std::string options;         ///< further words for `crackle campaign`
};

/// Shares of at least this work each: what a cluster needs to start one is little beside it, s.
inline constexpr double least_work_a_shard = 300.0;

/// Wall clock asked for a share, s: three times its part of the work, and five minutes.
double wall_limit(const BatchRequest& request);

/// What the largest of so many shares has of a plan's tests: packings are dealt out whole where there are enough.
double largest_share(const Plan& plan, int shards);

/// A script for Slurm's sbatch: an array with one task a share. Submitted again it goes on.
std::string batch_script(const BatchRequest& request);

}  // namespace crackle
