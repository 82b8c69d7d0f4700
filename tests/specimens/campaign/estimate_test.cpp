// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the time estimate of a plan before it has begun, and the script for a cluster.

#include "specimens/campaign/estimate.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

TEST(Estimate, IsOfTheRightSizeBeforeAndOfTheMeasuredTestsAfterwards) {
    const testing::ScratchFolder scratch;
    const Plan plan = read_plan(testing::write_small_plan(scratch / "", 3));
    const PlanEstimate before = estimate_plan(plan, nullptr);
    ASSERT_EQ(before.kinds.size(), 2U);
    EXPECT_EQ(before.kinds[0].rows, 6);
    EXPECT_FALSE(before.kinds[0].measured);
    CampaignOptions options;
    options.folder = scratch / "out";
    const CampaignOutcome outcome = run_campaign(plan, options);
    const CampaignLedger ledger = CampaignLedger::read(outcome.ledger);
    const PlanEstimate after = estimate_plan(plan, &ledger);
    EXPECT_TRUE(after.kinds[0].measured && after.kinds[1].measured);
    EXPECT_TRUE(testing::agrees("all tests, as measured", after.seconds, outcome.processor_seconds, 1e-9));
    fmt::print("  estimated {:.3g} s, took {:.3g} s\n", before.seconds, outcome.processor_seconds);
    EXPECT_GT(before.seconds, outcome.processor_seconds / 20.0);
    EXPECT_LT(before.seconds, outcome.processor_seconds * 20.0);
}

/// A test takes twice as long at half the time step, and at half the rate.
TEST(Estimate, CompanionsTakeTwiceAsLong) {
    const testing::ScratchFolder scratch;
    testing::write_packed_case(scratch / "tension.toml");
    testing::write_text(scratch / "plan.toml", "[[test]]\ncase = \"tension.toml\"\n[packings]\ncount = 3\n");
    const PlanEstimate alone = estimate_plan(read_plan(scratch / "plan.toml"), nullptr);
    const PlanEstimate all = estimate_plan(read_plan(scratch / "plan.toml", true), nullptr);
    EXPECT_EQ(alone.kinds[0].rows, 3);
    EXPECT_EQ(all.kinds[0].rows, 9);
    EXPECT_TRUE(testing::agrees("three tests", alone.seconds, 3.0 * alone.kinds[0].seconds, 1e-12));
    EXPECT_TRUE(testing::agrees("with companions", all.seconds, (3.0 + 6.0 * 2.0) * all.kinds[0].seconds, 1e-12));
}

TEST(BatchScript, LargestShareHasWholePackingsOrSingleTests) {
    Plan plan;
    plan.packings = 10;
    plan.rows.resize(200);
    EXPECT_EQ(largest_share(plan, 4), 0.3) << "three packings of ten";
    EXPECT_EQ(largest_share(plan, 40), 0.025) << "five tests of 200";
    EXPECT_EQ(largest_share(plan, 1), 1.0);
}

TEST(BatchScript, AsksForThreeTimesTheWorkOfAShareAndQuotesPaths) {
    const BatchRequest request{"/opt/crackle", "/data/o'brien/my plan.toml", "/scratch/out 50%", 20, 2, 7200.0, 0.05,
                               " --verify"};
    EXPECT_TRUE(testing::agrees("wall clock of a share, s", wall_limit(request), 300.0 + 3.0 * 7200.0 / 40.0, 1e-12));
    const std::string script = batch_script(request);
    for (const char* part :
         {"#SBATCH --array=1-20\n", "#SBATCH --cpus-per-task=2\n", "#SBATCH --time=0:14:00\n",
          "#SBATCH --job-name=crackle-my_plan\n", "exec >'/scratch/out 50%/shards'/\"$SLURM_ARRAY_TASK_ID.log\" 2>&1\n",
          "'/data/o'\\''brien/my plan.toml'", "--shard \"$SLURM_ARRAY_TASK_ID/20\" --workers 2 --verify -q\n"})
        EXPECT_NE(script.find(part), std::string::npos) << part << " in\n" << script;
    const testing::ScratchFolder scratch;
    testing::write_text(scratch / "script", script);
    EXPECT_EQ(std::system(("bash -n '" + (scratch / "script").string() + "'").c_str()), 0) << "no shell reads it";
}

}  // namespace
}  // namespace crackle
