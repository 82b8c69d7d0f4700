// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a campaign in which some tests end without a result, because of their case or because of the system.

#include "specimens/campaign/campaign.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/campaign/packing_store.hpp"
#include "tests/specimens/campaign/small_campaign.hpp"
#include "tests/support/killed_workers.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::write_small_plan;
using testing::write_text;

using OutcomesTest = testing::SmallCampaign;

TEST_F(OutcomesTest, ATestThatGoesWrongIsARowAndIsRunAgainWhereAskedFor) {
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

TEST_F(OutcomesTest, ARefusedCaseIsARowWithItsReason) {
    // If the grips hold all bodies, nothing can be pulled; this is found only once the specimen is bonded.
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

// Any later test would fail in the same way, so the failure is not attributed to a test.
TEST_F(OutcomesTest, AFolderThatCannotBeWrittenStopsItAndMarksNoTest) {
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
            EXPECT_NE(std::string(error.what()).find("; run the same command again to resume"), std::string::npos);
        }
        const LedgerTable wrong =
            CampaignLedger::read(ledger_file(folder_ / name)).query("SELECT count(*) FROM test WHERE state <> 'done'");
        EXPECT_EQ(std::get<double>(wrong.rows[0][0]), 0.0) << keep;
        fs::remove(folder_ / name / place);
        EXPECT_EQ(run(name).progress.done, 4) << keep;
    }
}

// If a worker is killed by another process, its test is run again by any worker and counted once.
TEST_F(OutcomesTest, AKilledWorkersTestIsRunAgain) {
    write_small_plan(folder_, 6);
    run("undisturbed");
    const pid_t process = ::fork();
    if (process == 0) {
        run("out", 2);
        std::_Exit(0);
    }
    int killed = 0, status = 0;
    // Always kills the older of the two workers, soon after the other was killed. No test is then killed three times,
    // and the campaign cannot end before.
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

// A system error may not occur again, so it must not be recorded as a judgement on the case.
TEST_F(OutcomesTest, AKilledTestIsRunAgainByTheSameCommand) {
    write_small_plan(folder_, 1);
    run("undisturbed");
    const pid_t process = ::fork();
    if (process == 0) {
        run("out", 1);
        std::_Exit(0);
    }
    testing::kill_workers(process, 7);
    int status = 0;
    ::waitpid(process, &status, 0);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    const LedgerCounts counts = ledger("out").counts();
    const LedgerTable wrong = ledger("out").query("SELECT state, message FROM test WHERE state <> 'done'");
    ASSERT_GE(wrong.rows.size(), 1U);
    fmt::print("  {}: {}\n", std::get<std::string>(wrong.rows[0][0]), std::get<std::string>(wrong.rows[0][1]));
    EXPECT_EQ(std::get<std::string>(wrong.rows[0][0]), row_crashed);
    EXPECT_NE(std::get<std::string>(wrong.rows[0][1]).find("memory"), std::string::npos);
    EXPECT_EQ(counts.failures, static_cast<std::int64_t>(wrong.rows.size()));
    const CampaignOutcome again = run("out");
    EXPECT_EQ(again.run, counts.failures) << "those alone";
    EXPECT_EQ(again.progress.done, 4);
    EXPECT_EQ(again.progress.gone_wrong, 0);
    EXPECT_EQ(table("out"), table("undisturbed"));
}

// A single crash may be chance. After two crashes, the test would presumably always crash, so it is not tried again.
TEST_F(OutcomesTest, ATestThatCrashesTwiceIsNamedAndOneThatCrashesOnceIsDone) {
    write_small_plan(folder_, 1);
    run("undisturbed");
    for (const int crashes : {2, 3}) {  // the first crash occurs while the packing is made
        const std::string name = fmt::format("out-{}", crashes);
        const pid_t process = ::fork();
        if (process == 0) {
            const CampaignOutcome outcome = run(name, 1);
            write_text(folder_ / "failure", outcome.failure);
            std::_Exit(0);
        }
        ASSERT_EQ(testing::kill_workers(process, crashes, SIGABRT), crashes);
        int status = 0;
        ::waitpid(process, &status, 0);
        ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        EXPECT_EQ(ledger(name).counts().failures, crashes - 2) << crashes;
        const std::string failure = read_file(folder_ / "failure");
        fmt::print("  {}\n", failure);
        if (crashes == 3) {
            EXPECT_NE(failure.find(", seed 1: crashed: its process was ended by signal 6 (Aborted) in each of 2 tries"),
                      std::string::npos);
            EXPECT_EQ(run(name).run, 1) << "that one alone";
        }
        EXPECT_EQ(table(name), table("undisturbed"));
    }
}

TEST_F(OutcomesTest, ThatAllTestsFailIsNoInterrupt) {
    write_small_plan(folder_, 1);
    const pid_t process = ::fork();
    if (process == 0) {
        const CampaignOutcome outcome = run("out", 1);
        std::_Exit(outcome.interrupted ? 2 : outcome.progress.failures == 4 ? 0 : 1);
    }
    ASSERT_EQ(testing::kill_workers(process, 9, SIGABRT), 9);  // one in the packing, two in each test
    int status = 0;
    ::waitpid(process, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << WEXITSTATUS(status);
    EXPECT_EQ(run("out").progress.done, 4);
}

/// During its lifetime, the process cannot open further files.
class NoFurtherFile {
  public:
    NoFurtherFile() {
        ::getrlimit(RLIMIT_NOFILE, &before_);
        const rlimit none{3, before_.rlim_max};
        ::setrlimit(RLIMIT_NOFILE, &none);
    }
    NoFurtherFile(const NoFurtherFile&) = delete;
    NoFurtherFile& operator=(const NoFurtherFile&) = delete;
    ~NoFurtherFile() { ::setrlimit(RLIMIT_NOFILE, &before_); }

  private:
    rlimit before_{};
};

TEST_F(OutcomesTest, AFileThatTheSystemDoesNotOpenIsNoRefusal) {
    write_small_plan(folder_, 1);
    run("out");
    const Plan plan = read_plan(folder_ / "plan.toml");
    FileHashes files;
    PackingStore packings(folder_ / "out/packings", files);
    const ResolvedCase test = plan.test_of(plan.rows[0]);
    RowResult result;
    {
        const NoFurtherFile full;
        result = run_row(test, {"identity", "name"}, Keep::figures, {folder_ / "out"}, packings);
    }
    EXPECT_EQ(result.state, row_failed) << result.message;
    EXPECT_EQ(result.exit, 4);
    EXPECT_NE(result.message.find("Too many open files"), std::string::npos) << result.message;
    EXPECT_EQ(run_row(test, {"identity", "name"}, Keep::figures, {folder_ / "out"}, packings).state, row_done);
}

TEST(RowKinds, TellResultsVerdictsAndFailuresOfTheSystemApart) {
    EXPECT_EQ(kind_of_row(row_done), RowKind::result);
    for (const char* state : {row_refused, row_unstable, row_timed_out})
        EXPECT_EQ(kind_of_row(state), RowKind::verdict) << state;
    for (const char* state : {row_failed, row_crashed}) EXPECT_EQ(kind_of_row(state), RowKind::failure) << state;
    EXPECT_EQ(spoken_wrong(3, 0), "3 gone wrong");
    EXPECT_EQ(spoken_wrong(3, 1),
              "3 gone wrong, 1 of them because of a system error; run the same command again to repeat it");
}

}  // namespace
}  // namespace crackle
