// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates how long a plan will take before it starts, and writes a script that runs it on a cluster.
// Tested by tests/specimens/campaign/estimate_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

/// Estimated cost of the rows of one test.
struct KindEstimate {
    std::string test;
    std::int64_t rows = 0;  ///< number of rows in the plan
    double seconds = 0.0;   ///< processor time of one row, s
    /// Whether the time is the mean of finished tests. Otherwise, --check estimates it at the first and last point.
    bool measured = false;
    std::vector<std::string> warnings;  ///< warnings from --check
};

/// Estimated cost of a plan.
struct PlanEstimate {
    std::vector<KindEstimate> kinds;
    double seconds = 0.0;  ///< processor time of all rows, s
};

/// Estimates the cost of each test of a plan. @param ledger  ledger of earlier runs of the plan, or nullptr
/// @throws the exceptions of check_test()
PlanEstimate estimate_plan(const Plan& plan, const CampaignLedger* ledger, const TestHooks& hooks = {});

/// Data from which batch_script() writes a script for a cluster.
struct BatchRequest {
    std::filesystem::path program, plan, folder;  ///< absolute paths
    int shards = 1, workers = 1;
    double seconds = 0.0;        ///< processor time of all rows, s
    double largest_share = 1.0;  ///< fraction of the work in the largest shard
    std::string options;         ///< further arguments for `crackle campaign`
};

/// Smallest amount of work per shard, s, for which the start-up time on a cluster is comparatively small.
inline constexpr double least_work_a_shard = 300.0;

/// Wall-clock time to request for a shard, s: three times the estimate for the shard, plus five minutes.
double wall_limit(const BatchRequest& request);

/// Fraction of a plan's tests in the largest of `shards` shards. Tests with the same packing are in one shard if there
/// are at least as many packings as shards.
double largest_share(const Plan& plan, int shards);

/// A script for Slurm's sbatch: an array job with one task per shard. If submitted again, the tasks resume.
std::string batch_script(const BatchRequest& request);

}  // namespace crackle
