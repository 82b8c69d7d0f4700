// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign from its plan to its table: each test once, the figures of the same test run alone, whatever happens.

#include "specimens/campaign/campaign.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <regex>
#include <set>
#include <thread>

#include "solver/base/errors.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/loading/run.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::write_small_plan;
using testing::write_text;

class CampaignTest : public ::testing::Test {
  protected:
    CampaignOutcome run(const std::string& folder, int workers = 2, Shard shard = {}, bool companions = false) const {
        CampaignOptions options;
        options.folder = folder_ / folder;
        options.workers = workers;
        options.shard = shard;
        return run_campaign(read_plan(folder_ / "plan.toml", companions), options);
    }
    std::string table(const std::string& folder) const {
        return tests_csv(CampaignLedger::read(ledger_file(folder_ / folder)).results());
    }

    testing::ScratchFolder scratch_;
    fs::path folder_ = scratch_ / "";
};

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
    EXPECT_EQ(more.run, 4) << "the third packing alone";
    EXPECT_EQ(more.progress.done, 12);
    write_text(folder_ / "plan.toml", "title = \"A small rock\"\n[[test]]\ncase = \"tension.toml\"\n");
    EXPECT_EQ(run("out").run, 1) << "an angle of 27 degrees was not among them";
    write_small_plan(folder_, 2);
    EXPECT_EQ(run("out").run, 0);
    EXPECT_EQ(table("out"), before) << "to the byte, whatever was run between";
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
    EXPECT_EQ(gather_shards(folder_ / "shared").tests, 0) << "any number of times";
    EXPECT_EQ(table("shared"), table("whole"));
    EXPECT_EQ(run("shared").run, 0) << "and gone on with";
}

TEST_F(CampaignTest, RefusesSharesOfDifferentPlans) {
    write_small_plan(folder_, 2);
    run("shared", 1, {1, 2});
    write_small_plan(folder_, 3);
    run("shared", 1, {2, 2});
    EXPECT_THROW(gather_shards(folder_ / "shared"), InputError);
    EXPECT_EQ(run("shared").run, 4)
        << "the tests of both are gathered: those of the third packing's first share are left";
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
    EXPECT_EQ(plan.test_of(plan.rows[0]).packing.seed, 7);
    EXPECT_EQ(plan.test_of(plan.rows[1]).packing.seed, 8);
    EXPECT_EQ(run("out").run, 2) << "two specimens";
    write_text(folder_ / "plan.toml",
               "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"packing.seed\"\n"
               "values = [7, 8]\n[packings]\ncount = 2\n");
    EXPECT_THROW(read_plan(folder_ / "plan.toml"), InputError) << "which of the two is it?";
}

TEST_F(CampaignTest, CurvesAskedForLaterAreMade) {
    write_small_plan(folder_, 1);
    run("out");
    write_small_plan(folder_, 1, "[run]\nkeep = \"curves\"\n");
    EXPECT_EQ(run("out").run, 4);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/curves"), fs::directory_iterator()), 4);
    EXPECT_EQ(run("out").run, 0);
}

TEST_F(CampaignTest, AnAxisOfAKeyThatIsAFigureTooKeepsBothApart) {
    testing::write_packed_case(folder_ / "tension.toml");
    write_text(folder_ / "plan.toml",
               "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"packing.mean_overlap\"\n"
               "values = [7e-5, 8e-5]\n");
    run("out");
    const LedgerTable results = CampaignLedger::read(ledger_file(folder_ / "out")).results();
    for (const char* column : {"packing.mean_overlap", "packing.mean_overlap (reached)"})
        EXPECT_EQ(std::count(results.columns.begin(), results.columns.end(), column), 1) << column;
}

TEST_F(CampaignTest, ATestThatGoesWrongIsARowAndIsRunAgainWhereAskedFor) {
    write_small_plan(folder_, 1, "[run]\ntime_limit = 1e-4\n");
    std::vector<std::string> told;
    CampaignOptions options;
    options.folder = folder_ / "out";
    CampaignHooks hooks;
    hooks.told = [&](const std::string& text) { told.push_back(text); };
    const CampaignOutcome slow = run_campaign(read_plan(folder_ / "plan.toml"), options, hooks);
    EXPECT_EQ(slow.progress.gone_wrong, 4);
    ASSERT_EQ(told.size(), 4U);
    EXPECT_NE(told[0].find("took more than time_limit = 0.0001 s"), std::string::npos) << told[0];
    write_small_plan(folder_, 1);
    EXPECT_EQ(run_campaign(read_plan(folder_ / "plan.toml"), options).run, 0) << "not by itself";
    options.retry = true;
    EXPECT_EQ(run_campaign(read_plan(folder_ / "plan.toml"), options).progress.done, 4);
}

TEST_F(CampaignTest, ARefusedCaseIsARowWithItsReason) {
    // A grip that holds everything leaves nothing to pull apart: only the bonded specimen shows it.
    testing::write_packed_case(folder_ / "tension.toml", "tension", "[numerics]\ntime_step = 1.0\n");
    write_text(folder_ / "plan.toml", "[[test]]\ncase = \"tension.toml\"\n");
    const CampaignOutcome outcome = run("out");
    EXPECT_EQ(outcome.progress.gone_wrong, 1);
    const LedgerTable wrong = CampaignLedger::read(outcome.ledger).query("SELECT state, message, exit FROM test");
    ASSERT_EQ(wrong.rows.size(), 1U);
    fmt::print("  {}: {}\n", std::get<std::string>(wrong.rows[0][0]), std::get<std::string>(wrong.rows[0][1]));
    EXPECT_EQ(std::get<std::string>(wrong.rows[0][0]), row_refused);
    EXPECT_NE(std::get<std::string>(wrong.rows[0][1]).find("time_step"), std::string::npos);
    EXPECT_EQ(std::get<double>(wrong.rows[0][2]), 2.0);
}

TEST_F(CampaignTest, KeepsCurvesOrEverythingWhereAskedFor) {
    write_small_plan(folder_, 1, "[run]\nkeep = \"curves\"\n");
    run("curves");
    write_small_plan(folder_, 1, "[run]\nkeep = \"all\"\n");
    run("all");
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "curves/curves")) {
        ++files;
        const fs::path whole = folder_ / "all/tests" / entry.path().stem() / "curve.csv";
        EXPECT_EQ(read_file(entry.path()), read_file(whole));
    }
    EXPECT_EQ(files, 4U);
    EXPECT_EQ(table("curves"), table("all"));
}

TEST_F(CampaignTest, WhatIsKeptIsNamedByTestPointAndPackingAndFoundByIdentity) {
    write_small_plan(folder_, 1, "[run]\nkeep = \"all\"\n");
    const CampaignOutcome outcome = run("out");
    const std::regex readable("(tension|compression)-friction_angle=(20|35)-packing1-[0-9a-f]{12}");
    std::set<std::string> points;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/tests")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::regex_match(name, readable)) << name;
        points.insert(name.substr(0, name.rfind('-')));
    }
    EXPECT_EQ(points.size(), 4U);
    // Earlier versions named them by all digits of the identity: they are found, and nothing is run again.
    const LedgerTable tests = CampaignLedger::read(outcome.ledger).query("SELECT identity FROM test");
    ASSERT_EQ(tests.rows.size(), 4U);
    for (const auto& row : tests.rows) {
        const std::string identity = std::get<std::string>(row[0]);
        const auto named = KeptTests(folder_ / "out").folder(identity);
        ASSERT_TRUE(named.has_value()) << identity;
        fs::rename(*named, folder_ / "out/tests" / identity);
        EXPECT_EQ(KeptTests(folder_ / "out").curve(identity), folder_ / "out/tests" / identity / "curve.csv");
    }
    EXPECT_EQ(run("out").run, 0);
    EXPECT_FALSE(KeptTests(folder_ / "out").name("0123456789abcdef0123456789abcdef").has_value());
}

TEST_F(CampaignTest, APointOfManyAxesIsNamedByItsNumber) {
    Plan plan = read_plan(write_small_plan(folder_));
    const PlanRow& row = plan.rows.back();
    const std::string identity = "0123456789abcdef0123456789abcdef";
    EXPECT_EQ(kept_name(plan, row, identity), "compression-friction_angle=35-packing2-0123456789ab");
    for (const char* key : {"mineral[1].contact_modulus", "mineral[2].contact_modulus", "material.tensile_strength"})
        plan.points[row.point].settings.push_back({key, CaseValue(6e10), "plan.toml"});
    EXPECT_EQ(kept_name(plan, row, identity), "compression-point4-packing2-0123456789ab");
    plan.points[row.point].settings = {{"mineral[1].cohesion", CaseValue(6e7), "plan.toml"}};
    plan.tests[1].name = "Größe/1";
    const std::string odd = kept_name(plan, row, identity);
    EXPECT_EQ(odd.find('/'), std::string::npos) << odd;
    EXPECT_NE(odd.find("-mineral1.cohesion="), std::string::npos) << odd;
}

// The parent is killed at moments spread over the campaign; the same command then goes on.
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
    EXPECT_EQ(std::get<double>(tries.rows[0][0]), 1.0) << "no test has ended twice";
    EXPECT_EQ(std::get<double>(tries.rows[0][1]), 12.0);
}

// Whatever is asked for next would fail alike: no test has gone wrong.
TEST_F(CampaignTest, AFolderThatCannotBeWrittenStopsItAndMarksNoTest) {
    for (const auto& [keep, place] :
         {std::pair("curves", "curves"), std::pair("all", "tests"), std::pair("figures", "packings")}) {
        const std::string name = fmt::format("out-{}", keep);
        write_small_plan(folder_, 1, fmt::format("[run]\nkeep = \"{}\"\n", keep));
        fs::create_directories(folder_ / name / "shards");
        write_text(folder_ / name / place, "a file where a folder should be");
        try {
            run(name);
            ADD_FAILURE() << keep << ": it went on";
        } catch (const OutputError& error) {
            fmt::print("  {}\n", error.what());
            EXPECT_NE(std::string(error.what()).find("; the same command goes on"), std::string::npos);
        }
        const LedgerTable wrong =
            CampaignLedger::read(ledger_file(folder_ / name)).query("SELECT count(*) FROM test WHERE state <> 'done'");
        EXPECT_EQ(std::get<double>(wrong.rows[0][0]), 0.0) << keep;
        fs::remove(folder_ / name / place);
        EXPECT_EQ(run(name).progress.done, 4) << keep;
    }
}

// Others may end a worker: its test is run again, by whichever worker, and counted once.
TEST_F(CampaignTest, AKilledWorkersTestIsRunAgain) {
    write_small_plan(folder_, 6);
    run("undisturbed");
    const pid_t process = ::fork();
    if (process == 0) {
        run("out", 2);
        std::_Exit(0);
    }
    int killed = 0, status = 0;
    // Always the older of the two, soon after the other: no test three times, and the campaign cannot end before.
    while (killed < 4 && ::waitpid(process, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
        const std::string children = read_file(fmt::format("/proc/{0}/task/{0}/children", process));
        if (children.empty()) continue;
        ::kill(std::atoi(children.c_str()), SIGKILL);
        ++killed;
    }
    if (killed == 4) ::waitpid(process, &status, 0);
    fmt::print("  {} workers killed\n", killed);
    EXPECT_GE(killed, 3);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_EQ(table("out"), table("undisturbed"));
}

TEST(CampaignFigures, OfListsAreThoseOfTheirElements) {
    const TestSummary summary = TestSummary::parse(R"({"peak_stress": 3.0, "notices": [{"text": "long"}],
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
        << "friction is no part of it";
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
    EXPECT_EQ(points[0].planned, 3) << "companions are no packings of their own";
    EXPECT_EQ(points[0].figures.at("peak_stress").count, 3U);
    const MeanBias& solved = points[0].biases.at("youngs_modulus");
    EXPECT_EQ(solved.packings, 3U);
    EXPECT_EQ(solved.value, 0.0) << "a solve knows neither step nor rate";
    const MeanBias& strength = points[0].biases.at("peak_stress");
    fmt::print("  strength: bias {:.3g} +- {:.3g} of {:.4g}: {}\n", strength.value, strength.standard_error,
               points[0].figures.at("peak_stress").mean, verdict_on(points[0].figures.at("peak_stress"), strength));
    EXPECT_TRUE(std::isfinite(strength.standard_error));
    EXPECT_NE(strength.step, 0.0);
}

}  // namespace
}  // namespace crackle
