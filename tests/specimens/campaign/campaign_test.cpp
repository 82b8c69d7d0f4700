// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a campaign from its plan to its table: each test runs once and gives the same results as when it runs alone,
// whatever happens.

#include "specimens/campaign/campaign.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "solver/base/errors.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tests/specimens/campaign/small_campaign.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::write_small_plan;
using testing::write_text;

using CampaignTest = testing::SmallCampaign;

TEST_F(CampaignTest, GivesTheFiguresOfTheSameTestsRunAlone) {
    const Plan plan = read_plan(write_small_plan(folder_));
    const CampaignOutcome outcome = run("out");
    EXPECT_EQ(outcome.progress.done, 8);
    EXPECT_EQ(outcome.run, 8);
    const LedgerTable results = CampaignLedger::read(outcome.ledger).results();
    ASSERT_EQ(results.rows.size(), plan.rows.size());
    std::size_t compared = 0;
    for (std::size_t k = 0; k < plan.rows.size(); ++k) {
        TestOptions options;
        options.folder = folder_ / fmt::format("alone-{}", k);
        const auto alone = figures_of(run_test(plan.test_of(plan.rows[k]), options).summary);
        for (const auto& [name, value] : alone) {
            const auto column = std::find(results.columns.begin(), results.columns.end(), name);
            ASSERT_NE(column, results.columns.end()) << name;
            const LedgerCell& cell = results.rows[k][static_cast<std::size_t>(column - results.columns.begin())];
            if (const auto* word = std::get_if<std::string>(&value))
                EXPECT_EQ(std::get<std::string>(cell), *word) << name;
            else
                EXPECT_EQ(std::get<double>(cell), std::get<double>(value)) << name;
            ++compared;
        }
    }
    fmt::print("  {} figures compared, to the bit\n", compared);
    EXPECT_GT(compared, 400U);
}

TEST_F(CampaignTest, MakesEachPackingOnceAndTheSameOnesForAllPoints) {
    write_small_plan(folder_, 2);
    run("out");
    const auto files = std::distance(fs::directory_iterator(folder_ / "out/packings"), fs::directory_iterator());
    EXPECT_EQ(files, 2) << "two packings for eight tests, and nothing else";
    const LedgerTable results = CampaignLedger::read(ledger_file(folder_ / "out")).results();
    const auto ratio = static_cast<std::size_t>(
        std::find(results.columns.begin(), results.columns.end(), "packing.void_ratio") - results.columns.begin());
    for (std::size_t k = 0; k < results.rows.size(); ++k)
        EXPECT_EQ(results.rows[k][ratio], results.rows[k / 4 * 4][ratio]);
    EXPECT_NE(results.rows[0][ratio], results.rows[4][ratio]);
}

TEST_F(CampaignTest, AnotherRunFindsNothingLeftAndAnotherAxisReusesWhatThereIs) {
    write_small_plan(folder_, 2);
    run("out");
    const std::string before = table("out");
    EXPECT_EQ(run("out").run, 0);
    EXPECT_EQ(table("out"), before);
    write_small_plan(folder_, 3);
    const CampaignOutcome more = run("out");
    EXPECT_EQ(more.run, 4) << "only the third packing";
    EXPECT_EQ(more.progress.done, 12);
    write_text(folder_ / "plan.toml", "title = \"A small rock\"\n[[test]]\ncase = \"tension.toml\"\n");
    EXPECT_EQ(run("out").run, 1) << "an angle of 27 degrees was not tried";
    write_small_plan(folder_, 2);
    EXPECT_EQ(run("out").run, 0);
    EXPECT_EQ(table("out"), before) << "equal bytes, regardless of what ran in between";
}

TEST_F(CampaignTest, NumberOfWorkersChangesNothing) {
    write_small_plan(folder_, 2);
    run("one", 1);
    run("three", 3);
    EXPECT_EQ(table("one"), table("three"));
}

TEST_F(CampaignTest, SharesGatherToTheSameTableInAnyOrder) {
    write_small_plan(folder_, 3);
    run("whole");
    for (const int k : {3, 1}) run("shared", 1, {k, 3});
    EXPECT_EQ(gather_shards(folder_ / "shared").counts.done, 8) << "two of three packings";
    run("shared", 1, {2, 3});
    EXPECT_EQ(gather_shards(folder_ / "shared").tests, 4);
    EXPECT_EQ(gather_shards(folder_ / "shared").tests, 0) << "gathering can be repeated";
    EXPECT_EQ(table("shared"), table("whole"));
    EXPECT_EQ(run("shared").run, 0) << "the campaign can be continued";
}

TEST_F(CampaignTest, OneShareHasItsOwnLedgerAndIsGathered) {
    write_small_plan(folder_, 1);
    run("whole");
    EXPECT_EQ(run("shared", 1, {1, 1}).ledger, folder_ / "shared/shards/1.sqlite");
    EXPECT_EQ(gather_shards(folder_ / "shared").counts.done, 4);
    EXPECT_EQ(table("shared"), table("whole"));
}

TEST_F(CampaignTest, RefusesSharesOfDifferentPlans) {
    write_small_plan(folder_, 2);
    run("shared", 1, {1, 2});
    write_small_plan(folder_, 3);
    run("shared", 1, {2, 2});
    EXPECT_THROW(gather_shards(folder_ / "shared"), InputError);
    EXPECT_EQ(run("shared").run, 4) << "tests of both are gathered; those of the third packing's first share remain";
}

TEST_F(CampaignTest, MoreSharesThanPackingsShareOutSingleTests) {
    write_small_plan(folder_, 1);
    run("whole");
    for (const int k : {1, 2, 3}) EXPECT_GE(run("shared", 1, {k, 3}).run, 1) << "share " << k;
    gather_shards(folder_ / "shared");
    EXPECT_EQ(table("shared"), table("whole"));
}

TEST_F(CampaignTest, WithoutPackingsACaseHasItsOwnSeedAndAnAxisMayHaveIt) {
    testing::write_packed_case(folder_ / "tension.toml");
    write_text(folder_ / "plan.toml",
               "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"packing.seed\"\nvalues = [7, 8]\n");
    const Plan plan = read_plan(folder_ / "plan.toml");
    ASSERT_EQ(plan.rows.size(), 2U);
    EXPECT_EQ(plan.test_of(plan.rows[0]).packing()->seed, 7);
    EXPECT_EQ(plan.test_of(plan.rows[1]).packing()->seed, 8);
    EXPECT_EQ(run("out").run, 2) << "two specimens";
    write_text(folder_ / "plan.toml",
               "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"packing.seed\"\n"
               "values = [7, 8]\n[packings]\ncount = 2\n");
    EXPECT_THROW(read_plan(folder_ / "plan.toml"), InputError) << "which of the two is it?";
}

// The parent process is killed at several moments during the campaign; the same command then resumes it.
TEST_F(CampaignTest, KilledAtAnyMomentItGoesOnToTheSameTable) {
    write_small_plan(folder_, 3);
    run("undisturbed", 1);
    int killed = 0;
    for (int moment = 0; moment < 12; ++moment) {
        const pid_t process = ::fork();
        if (process == 0) {
            run("disturbed", 2);
            std::_Exit(0);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(40 + 35 * moment));
        ::kill(process, SIGKILL);
        int status = 0;
        ::waitpid(process, &status, 0);
        killed += WIFSIGNALED(status) ? 1 : 0;
    }
    fmt::print("  killed {} times\n", killed);
    EXPECT_GE(killed, 1);
    const CampaignOutcome outcome = run("disturbed", 2);
    EXPECT_EQ(outcome.progress.done, 12);
    EXPECT_EQ(table("disturbed"), table("undisturbed"));
    const LedgerTable tries = CampaignLedger::read(outcome.ledger).query("SELECT max(tries), count(*) FROM test");
    EXPECT_EQ(std::get<double>(tries.rows[0][0]), 1.0) << "no test is recorded twice";
    EXPECT_EQ(std::get<double>(tries.rows[0][1]), 12.0);
}

TEST(CampaignFigures, OfListsAreThoseOfTheirElements) {
    const Summary summary = parse_summary(R"({"peak_stress": 3.0, "notices": [{"text": "long"}],
        "cycles": [{"modulus": 1.0}, {"modulus": 2.0}], "joints": [{"source": "set", "at_peak": {"slip": 4.0}}],
        "traces": [{"length": 5.0}]})");
    const Figures expected{{"peak_stress", 3.0},
                           {"cycles[1].modulus", 1.0},
                           {"cycles[2].modulus", 2.0},
                           {"joints[1].source", "set"},
                           {"joints[1].at_peak.slip", 4.0}};
    EXPECT_EQ(figures_of(summary), expected);
    EXPECT_EQ(unit_of_figure("cycles[12].modulus", true), "Pa");
    EXPECT_EQ(unit_of_figure("joints[1].at_peak.slip", true), "m");
    EXPECT_EQ(unit_of_figure("joints[1].at_peak.failed_share", true), "");
}

TEST_F(CampaignTest, ASecondOneIsRefusedWithTheProcessThatHoldsTheFolder) {
    write_small_plan(folder_, 1);
    fs::create_directory(folder_ / "out");
    const FolderLock held(folder_ / "out");
    try {
        run("out");
        ADD_FAILURE() << "it was let in";
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_NE(std::string(error.what()).find(fmt::format("(process {})", ::getpid())), std::string::npos);
    }
}

TEST_F(CampaignTest, RefusesAFolderOfSomethingElseAndAFileThatIsNoLedger) {
    write_small_plan(folder_, 1);
    fs::create_directory(folder_ / "mine");
    write_text(folder_ / "mine/thesis.tex", "precious");
    EXPECT_THROW(run("mine"), InputError);
    fs::create_directory(folder_ / "other");
    write_text(folder_ / "other/campaign.sqlite",
               "this is no database, and it is long enough to look at: no, it is not");
    EXPECT_THROW(run("other"), InputError);
    EXPECT_EQ(read_file(folder_ / "mine/thesis.tex"), "precious");
    EXPECT_THROW(CampaignLedger::read(folder_ / "nowhere.sqlite"), InputError);
}

TEST_F(CampaignTest, ADamagedPackingIsMadeAgain) {
    write_small_plan(folder_, 1);
    run("out");
    for (const auto& entry : fs::directory_iterator(folder_ / "out/packings")) {
        std::string text = read_file(entry.path());
        text[text.size() / 2] = text[text.size() / 2] == '1' ? '2' : '1';
        write_text(entry.path(), text);
    }
    fs::create_directory(folder_ / "again");
    fs::copy(folder_ / "out/packings", folder_ / "again/packings", fs::copy_options::recursive);
    fs::create_directory(folder_ / "again/shards");
    run("again");
    EXPECT_EQ(table("again"), table("out"));
}

TEST_F(CampaignTest, PointsHaveTheMeansOfTheirPackings) {
    write_small_plan(folder_, 4);
    run("out");
    const LedgerTable results = CampaignLedger::read(ledger_file(folder_ / "out")).results();
    const auto points = summarise(results, {"peak_stress", "youngs_modulus"});
    ASSERT_EQ(points.size(), 4U);
    EXPECT_EQ(points[0].at(), "material.friction_angle = 20");
    const auto column = static_cast<std::size_t>(
        std::find(results.columns.begin(), results.columns.end(), "youngs_modulus") - results.columns.begin());
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += std::get<double>(results.rows[4 * k][column]);
    EXPECT_TRUE(testing::agrees("mean modulus", points[0].figures.at("youngs_modulus").mean, sum / 4.0, 1e-15));
    EXPECT_EQ(points[0].figures.at("youngs_modulus").mean, points[1].figures.at("youngs_modulus").mean)
        << "the result does not depend on friction";
    EXPECT_THROW(summarise(results, {"beauty"}), InputError);
    EXPECT_TRUE(points[0].biases.empty());
}

TEST_F(CampaignTest, CompanionsGiveEveryMeanItsBias) {
    write_text(folder_ / "plan.toml", "[[test]]\ncase = \"tension.toml\"\n[packings]\ncount = 3\n");
    testing::write_packed_case(folder_ / "tension.toml");
    run("out", 2, {}, true);
    const auto points =
        summarise(CampaignLedger::read(ledger_file(folder_ / "out")).results(), {"peak_stress", "youngs_modulus"});
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].planned, 3) << "companions do not count as packings";
    EXPECT_EQ(points[0].figures.at("peak_stress").count, 3U);
    const MeanBias& solved = points[0].biases.at("youngs_modulus");
    EXPECT_EQ(solved.packings, 3U);
    EXPECT_EQ(solved.value, 0.0) << "a linear solution has neither a step nor a rate";
    const MeanBias& strength = points[0].biases.at("peak_stress");
    fmt::print("  strength: bias {:.3g} +- {:.3g} of {:.4g}: {}\n", strength.value, strength.standard_error,
               points[0].figures.at("peak_stress").mean, verdict_on(points[0].figures.at("peak_stress"), strength));
    EXPECT_TRUE(std::isfinite(strength.standard_error));
    EXPECT_NE(strength.step, 0.0);
}

}  // namespace
}  // namespace crackle
