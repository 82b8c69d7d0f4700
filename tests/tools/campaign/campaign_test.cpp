// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle campaign` as called by a user: run, show, gather, submit; refusals, and the state after a signal.

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <sstream>

#include "solver/machine/processors_lent.hpp"
#include "tests/support/interrupted_call.hpp"
#include "tests/support/killed_workers.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::Answer;
using testing::interrupted_call;
using testing::write_small_plan;

class CampaignCommand : public testing::ProgramCall {
  protected:
    CampaignCommand() : ProgramCall("campaign") { write_small_plan(folder_, 2); }
};

/// The cells of a line of CSV; commas in quotes do not separate cells.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

/// Strengths of the tests of one kind and angle, from the rows of `show --tests`.
std::vector<double> strengths_of(const std::string& rows, const std::string& kind, const std::string& angle) {
    std::istringstream lines(rows);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> names = cells_of(line);
    const auto column = [&](const char* name) { return std::ranges::find(names, name) - names.begin(); };
    std::vector<double> strengths;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = cells_of(line);
        const auto cell = [&](const char* name) { return cells.at(static_cast<std::size_t>(column(name))); };
        if (cell("test") == kind && cell("material.friction_angle") == angle)
            strengths.push_back(std::stod(cell("peak_stress")));
    }
    return strengths;
}

TEST_F(CampaignCommand, RunsAndShowsMeansAndIntervals) {
    const Answer answer = call("plan.toml -o out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("8 of 8 tests done, 0 gone wrong, 0 left; this command ran 8"), std::string::npos)
        << answer.out;
    EXPECT_EQ(answer.err.find('\r'), std::string::npos) << "no progress line in a pipe";
    const Answer show = call("show out");
    EXPECT_EQ(show.code, 0) << show.err;
    for (const char* part :
         {"A small rock: 8 of 8 tests done", "tension, material.friction_angle = 20: 2 of 2 packings",
          "youngs_modulus N/m", "95 % interval", "notice: 2 of 2 are not valid for their kind"})
        EXPECT_NE(show.out.find(part), std::string::npos) << part << " in\n" << show.out;
    const Answer csv = call("show out --csv --figure peak_stress");
    EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 5) << csv.out;
    EXPECT_EQ(csv.out.rfind("test,material.friction_angle,planned,done,gone_wrong,failed_by_system,not_failed,figure,"
                            "unit,packings,mean,",
                            0),
              0U)
        << csv.out;
    const Answer tests = call("show out --tests");
    EXPECT_EQ(std::count(tests.out.begin(), tests.out.end(), '\n'), 9);
    const Answer quiet = call("plan.toml -o out -q");
    EXPECT_EQ(quiet.out + quiet.err, "");

    // The standard deviation of two strengths is their difference divided by the square root of 2. The interval of
    // their mean is half that difference times Student's t for one degree of freedom, whose quantile is a tangent.
    const std::string means = call("show out --figure peak_stress").out;
    for (const char* angle : {"20", "35"}) {
        const std::vector<double> two = strengths_of(tests.out, "compression", angle);
        ASSERT_EQ(two.size(), 2U) << angle;
        const double mean = 0.5 * (two[0] + two[1]), apart = std::abs(two[0] - two[1]);
        const double deviation = apart / std::sqrt(2.0), reach = 0.5 * apart * std::tan(0.475 * std::numbers::pi);
        const std::size_t at = means.find(fmt::format("compression, material.friction_angle = {}: 2 of 2", angle));
        ASSERT_NE(at, std::string::npos) << means;
        std::istringstream row(means.substr(means.find("peak_stress", at)));
        std::vector<std::string> words(10);
        for (std::string& word : words) row >> word;
        EXPECT_EQ(words, (std::vector<std::string>{
                             "peak_stress", "N/m", "2", fmt::format("{:.4g}", mean), fmt::format("{:.4g}", 0.5 * apart),
                             fmt::format("{:.4g}", mean - reach), "to", fmt::format("{:.4g}", mean + reach),
                             fmt::format("{:.4g}", deviation), fmt::format("{:.1f}", 100.0 * deviation / mean)}));
    }
}

TEST_F(CampaignCommand, IsDrawnAndReported) {
    write_small_plan(folder_, 3, "[run]\nkeep = \"all\"\n");
    ASSERT_EQ(call("plan.toml -o out -q").code, 0);
    const auto crackle = [&](const std::string& words) {
        return std::system(
            fmt::format("cd '{}' && '{}' {} > out.txt 2> err.txt", folder_.string(), CRACKLE_PROGRAM, words).c_str());
    };
    ASSERT_EQ(crackle("plot out -o figure.svg"), 0) << read("err.txt");
    EXPECT_GT(read("figure.svg").size(), 20'000U);
    EXPECT_NE(crackle("plot out -o figure.svg"), 0) << "nothing is replaced without --force";
    ASSERT_EQ(crackle("plot out -o one.svg --figure peak_stress"), 0) << read("err.txt");
    EXPECT_LT(read("one.svg").size(), read("figure.svg").size());
    std::size_t parts = 0;
    for (const char* part : {"curve", "axes", "scatter"}) {
        ASSERT_EQ(crackle(fmt::format("plot out -o {0}.svg --what {0}", part)), 0) << read("err.txt");
        EXPECT_LT(read(fmt::format("{}.svg", part)).size(), read("figure.svg").size());
        parts += read(fmt::format("{}.svg", part)).size();
    }
    EXPECT_GT(parts, read("figure.svg").size()) << "the parts together exceed the whole";
    ASSERT_EQ(crackle("plot out -o half.svg --test tension"), 0) << read("err.txt");
    EXPECT_LT(read("half.svg").size(), read("figure.svg").size());
    EXPECT_NE(crackle("plot out -o two.svg --test tense"), 0);
    EXPECT_NE(read("err.txt").find("found no test 'tense', expected one of compression, tension"), std::string::npos);
    EXPECT_NE(crackle("plot out -o two.svg --figure beauty"), 0);
    EXPECT_NE(read("err.txt").find("found no figure 'beauty'"), std::string::npos);
    ASSERT_EQ(crackle("report out"), 0) << read("err.txt");
    const std::string page = read("out/report.html");
    for (const char* part :
         {"<h1>A small rock</h1>", "12 of 12 tests done", "peak stress", "/summary.json\">summary.json</a>",
          "data:image/svg+xml;base64,", "tension against friction angle φ"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    // The cells of the table must equal the numbers of the CSV.
    const Answer csv = call("show out --csv --figure peak_stress");
    std::istringstream lines(csv.out);
    std::string line;
    std::vector<std::string> names, cells;
    for (auto* row : {&names, &cells}) {
        std::getline(lines, line);
        *row = cells_of(line);
    }
    const auto number = [&](const char* column) {
        return std::stod(cells[static_cast<std::size_t>(std::ranges::find(names, column) - names.begin())]);
    };
    const std::string row = fmt::format(
        "peak stress, kN/m</td><td>{:.4g} ± {:.2g}</td><td>{:.4g} to "
        "{:.4g}</td><td>{:.4g}</td><td>{:.1f}</td><td>{}</td></tr>",
        1e-3 * number("mean"), 1e-3 * number("standard_error"), 1e-3 * number("low_95"), 1e-3 * number("high_95"),
        1e-3 * number("standard_deviation"), 100.0 * number("standard_deviation") / number("mean"), number("packings"));
    EXPECT_NE(page.find(row), std::string::npos) << row;
    ASSERT_EQ(crackle("report out"), 0) << "a report replaces a report";
    EXPECT_EQ(read("out/report.html"), page);
}

TEST_F(CampaignCommand, DryRunJudgesAndEstimatesAndWritesNothing) {
    const auto before = snapshot();
    const Answer answer = call("plan.toml --dry-run -o out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("A small rock: 8 tests of 4 points with 2 packings"), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("of processor time, "), std::string::npos) << answer.out;
    EXPECT_TRUE(snapshot() == before) << "files were made";
}

TEST_F(CampaignCommand, RefusesWithOneLine) {
    expect_refused("", "found no PLAN.toml");
    expect_refused("plan.toml", "found no -o");
    expect_refused("none.toml -o out", "found no such file");
    expect_refused("plan.toml -o out --workers 0", "--workers: found 0");
    for (const char* shard : {"0/2", "3/2", "2", "a/b", "1/2x", "1/0"})
        expect_refused(std::string("plan.toml -o out --shard ") + shard, "expected I/N");
    expect_refused("show", "argument DIR is missing");
    expect_refused("show nowhere", "found no ledger");
    expect_refused("gather nowhere", "found no shards");
    write("plan.toml",
          "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"material.friction_angle\"\nvalues = [99]\n");
    expect_refused("plan.toml -o out", "found 99");
}

TEST_F(CampaignCommand, SharesAreGathered) {
    EXPECT_EQ(call("plan.toml -o out --shard 1/2 -q").code, 0);
    EXPECT_EQ(call("plan.toml -o out --shard 2/2 -q").code, 0);
    const Answer answer = call("gather out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("8 tests from 2 shares; 8 of 8 done"), std::string::npos) << answer.out;
    const std::string gathered = call("show out --tests").out;
    EXPECT_EQ(call("plan.toml -o whole -q").code, 0);
    EXPECT_EQ(call("show whole --tests").out, gathered);
}

TEST_F(CampaignCommand, SubmitsTheScriptThatDryRunShows) {
    const Answer script = call("submit plan.toml -o out --shards 3 --dry-run");
    EXPECT_EQ(script.code, 0) << script.err;
    for (const char* part :
         {"#!/bin/bash\n", "#SBATCH --array=1-3\n", "#SBATCH --time=0:", "--shard \"$SLURM_ARRAY_TASK_ID/3\""})
        EXPECT_NE(script.out.find(part), std::string::npos) << part << " in\n" << script.out;
    EXPECT_FALSE(exists("out"));
    // A replacement for sbatch that runs the tasks of the array one after another.
    write("sbatch",
          "#!/bin/sh\nfor k in 1 2 3; do SLURM_ARRAY_TASK_ID=$k bash \"$1\" || exit 1; done\n"
          "echo Submitted batch job 7\n");
    ::chmod((folder_ / "sbatch").c_str(), 0755);
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
    const Answer answer = call("submit plan.toml -o out --shards 3");
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("Submitted batch job 7"), std::string::npos) << answer.out;
    EXPECT_NE(call("gather out").out.find("8 of 8 done"), std::string::npos);
}

/// Restricts this process and those it starts to one of its processors, as a batch system would.
class OneProcessor {
  public:
    OneProcessor() {
        EXPECT_EQ(sched_getaffinity(0, sizeof all_, &all_), 0);
        cpu_set_t one;
        CPU_ZERO(&one);
        for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
            if (CPU_ISSET(k, &all_)) CPU_SET(k, &one);
        EXPECT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    }
    OneProcessor(const OneProcessor&) = delete;
    OneProcessor& operator=(const OneProcessor&) = delete;
    ~OneProcessor() { EXPECT_EQ(sched_setaffinity(0, sizeof all_, &all_), 0); }

  private:
    cpu_set_t all_{};
};

TEST_F(CampaignCommand, HasOneWorkerAndOneThreadWhereOneProcessorIsLent) {
    const OneProcessor lent;
    const Answer answer = call("plan.toml -o out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE((answer.out + answer.err).find("8 tests of 4 points with 2 packings, 1 worker"), std::string::npos)
        << answer.out << answer.err;
    ASSERT_EQ(std::system(fmt::format("cd '{}' && '{}' doctor > out.txt && '{}' pack --count 40 --mean-overlap 1e-4 "
                                      "--radius-min 1e-2 --radius-max 2e-2 --threads 2 -o p.dat > /dev/null 2> err.txt",
                                      folder_.string(), CRACKLE_PROGRAM, CRACKLE_PROGRAM)
                              .c_str()),
              0);
    EXPECT_NE(read("out.txt").find("\nthreads       1 of "), std::string::npos) << read("out.txt");
    EXPECT_NE(read("err.txt").find("1 of 2 threads are used: this process may use 1 processor"), std::string::npos)
        << read("err.txt");
}

TEST_F(CampaignCommand, AnInterruptLosesAtMostTheTestsAtWork) {
    write_small_plan(folder_, 30, "[run]\nkeep = \"curves\"\n");
    // More than run at the same time, so that some are in the ledger.
    const std::ptrdiff_t some = 2 * static_cast<std::ptrdiff_t>(processors_lent()) + 4;
    const auto some_are_done = [&] {
        return exists("out/curves") && std::distance(fs::directory_iterator(folder_ / "out/curves"), {}) >= some;
    };
    ASSERT_EQ(interrupted_call(folder_, {"campaign", "plan.toml", "-o", "out"}, SIGINT, some_are_done), 130);
    EXPECT_NE(read("err.txt").find("interrupted; run the same command again to resume"), std::string::npos)
        << read("err.txt");
    const Answer answer = call("plan.toml -o out");
    EXPECT_NE(answer.out.find(", 0 left; "), std::string::npos) << answer.out;
    EXPECT_EQ(answer.out.find("; 120 run now"), std::string::npos) << "finished tests were repeated: " << answer.out;
}

TEST_F(CampaignCommand, ExitCode1SaysThatAVerdictEndedTests) {
    write_small_plan(folder_, 1, "[run]\ntime_limit = 1e-4\n");
    const Answer answer = call("plan.toml -o out");
    EXPECT_EQ(answer.code, 1) << answer.err;
    EXPECT_NE(answer.out.find("0 of 4 tests done, 4 gone wrong, 0 left"), std::string::npos) << answer.out;
    EXPECT_EQ(call("plan.toml -o out").code, 1) << "failed tests are not repeated and remain failed";
    write_small_plan(folder_, 1);
    EXPECT_EQ(call("plan.toml -o out --retry").code, 0);
}

TEST_F(CampaignCommand, ExitCode4SaysThatTheSystemEndedTestsAndTheSameCommandRunsThemAgain) {
    ASSERT_EQ(call("plan.toml -o whole -q").code, 0);
    const std::string whole = call("show whole --tests").out;
    const pid_t process = testing::started_call(folder_, {"campaign", "plan.toml", "-o", "out", "--workers", "1"});
    testing::kill_workers(process, 5);
    EXPECT_EQ(testing::ended_call(process), 4) << read("err.txt");
    EXPECT_NE(read("out.txt").find(" of them because of a system error; run the same command again to repeat "),
              std::string::npos)
        << read("out.txt");
    EXPECT_NE(read("err.txt").find("crashed: its process was ended by signal 9"), std::string::npos) << read("err.txt");
    for (const char* means : {"show out", "show out --csv"}) EXPECT_EQ(call(means).code, 4) << "no mean without them";
    EXPECT_EQ(call("show out --wrong").code, 0);
    EXPECT_EQ(call("plan.toml -o out").code, 0);
    EXPECT_EQ(call("show out").code, 0);
    EXPECT_EQ(call("show out --tests").out, whole);
}

TEST_F(CampaignCommand, OneShareIsGatheredAsMany) {
    EXPECT_EQ(call("plan.toml -o out --shard 1/1 -q").code, 0);
    const Answer answer = call("gather out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("8 tests from 1 share; 8 of 8 done"), std::string::npos) << answer.out;
}

TEST_F(CampaignCommand, ListsTheKeysOfAPlan) {
    const Answer answer = call("--keys");
    EXPECT_EQ(answer.code, 0);
    for (const char* key : {"[[test]]", "[[axis]]", "[design]", "[packings]", "[run]", "time_limit"})
        EXPECT_NE(answer.out.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace crackle
