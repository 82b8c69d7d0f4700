// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle bench` as a user calls it: refusals, one quick claim, and the page's format.

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

class BenchCommand : public testing::ProgramCall {
  protected:
    BenchCommand() : ProgramCall("bench") {}
};

TEST_F(BenchCommand, RefusesStudiesAndClaimsItDoesNotKnow) {
    expect_refused("", "found no study, expected one of accuracy, verify");
    expect_refused("verfy", "found study 'verfy', expected one of accuracy, verify");
    expect_refused("verify --only no_such_claim", "found no claim 'no_such_claim'");
    expect_refused("verify --only two_discs_stacked_between_walls -o nowhere/page.md", "nowhere/page.md");
    expect_refused("verify --no-such-option", "no-such-option");
}

TEST_F(BenchCommand, ListsItsClaims) {
    const testing::Answer answer = call("verify --list");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("two_discs_stacked_between_walls\n"), std::string::npos) << answer.out;
    EXPECT_EQ(call("--help").code, 0);
    EXPECT_EQ(call("verify --help").code, 0);
}

TEST_F(BenchCommand, AccuracyWritesATableAndItsPicture) {
    expect_refused("accuracy --only no_such_study", "found no study 'no_such_study', expected one of bounce_energy");
    const testing::Answer answer =
        call("accuracy --quick -o curves --only bounce_energy --only chain_wave --only peak_circles");
    ASSERT_EQ(answer.code, 0) << answer.err;
    std::istringstream lines(read("curves/accuracy.csv"));
    std::map<std::string, double> error;  // by study, integrator, parameter, value
    std::string line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("# Made by `crackle bench accuracy --quick --only bounce_energy")) << line;
    while (std::getline(lines, line)) {
        if (line.starts_with('#') || line.starts_with("study,")) continue;
        std::vector<std::string> words;
        std::istringstream cells(line);
        for (std::string word; std::getline(cells, word, ',');) words.push_back(word);
        ASSERT_EQ(words.size(), 7u) << line;
        EXPECT_GT(std::stod(words[5]), 0.0) << line;
        error[words[0] + ' ' + words[2] + ' ' + words[3] + ' ' + words[4]] = std::stod(words[6]);
    }
    EXPECT_EQ(error.size(), 20u);
    EXPECT_LT(error.at("bounce_energy consistent time_step 0.2"), 1e-9);
    EXPECT_GT(error.at("bounce_energy leapfrog time_step 0.2"), 1e-4);
    // Second order in the step.
    EXPECT_NEAR(error.at("chain_wave leapfrog time_step 0.4") / error.at("chain_wave leapfrog time_step 0.2"), 4.0,
                0.5);
    EXPECT_LT(error.at("peak_circles leapfrog time_step 0.4"), 0.5);
    EXPECT_NE(read("curves/accuracy.gp").find("plot $bounce_energy_0"), std::string::npos);
    // Where there is no gnuplot, the message says so and the table is there all the same.
    if (answer.err.find("found no gnuplot") == std::string::npos) {
        EXPECT_NE(read("curves/accuracy.svg").find("<svg"), std::string::npos) << answer.err;
    }
}

TEST_F(BenchCommand, WritesAPageThatNamesItsCommandAndIsTheSameAgain) {
    const std::string words =
        "verify --only bond_squeezed_to_ten_times_its_strength_holds --only restitution_with_a_clamped_dashpot -o ";
    const testing::Answer answer = call(words + "page.md");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.out.empty()) << answer.out;
    EXPECT_NE(answer.err.find("bond_squeezed_to_ten_times_its_strength_holds"), std::string::npos) << answer.err;
    const std::string page = read("page.md");
    EXPECT_TRUE(page.starts_with("# Verification\n\nMade by `crackle bench verify -o page.md --only bond_squeezed_to"))
        << page;
    for (const char* part : {"| claim | rows | largest error / tolerance | verdict |", "\n## Bonds\n",
                             "\n### bond_squeezed_to_ten_times_its_strength_holds\n",
                             "| row | expected | got | error | tolerance | order (expected) | verdict |",
                             "| squeezing force over strength | 10 | 10 |", "| holds |", "| not offered |",
                             "2 claims; 4 rows hold, 0 fail, 0 are only shown, 4 are of options"})
        EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
    EXPECT_EQ(page.find("FAILS"), std::string::npos) << page;
    // Every line of a table has the columns of its head.
    std::istringstream lines(page);
    std::ptrdiff_t bars = 0;
    for (std::string line, before; std::getline(lines, line); before = line) {
        if (!line.starts_with('|')) continue;
        const std::ptrdiff_t here = std::count(line.begin(), line.end(), '|');
        if (before.starts_with('|')) {
            EXPECT_EQ(here, bars) << line;
        }
        bars = here;
    }
    ASSERT_EQ(call(words + "again/page.md").code, 2) << "its folder does not exist";
    std::filesystem::create_directory(folder_ / "again");
    ASSERT_EQ(call(words + "again/page.md").code, 0);
    EXPECT_EQ(read("again/page.md"), page);
}

TEST_F(BenchCommand, PrintsThePageWhereNoFileIsGiven) {
    const testing::Answer answer = call("verify --only two_discs_stacked_between_walls");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.out.starts_with("# Verification\n")) << answer.out;
    EXPECT_NE(answer.out.find("2.00 (2)"), std::string::npos) << "order of convergence\n" << answer.out;
}

}  // namespace
}  // namespace crackle
