// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle-bench` as called by a user: help, refusals, verbosity, one quick claim, and the format of the page.

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program_call.hpp"
#include "tests/support/terminal_call.hpp"

namespace crackle {
namespace {

class BenchCommand : public testing::ProgramCall {
  protected:
    BenchCommand() : ProgramCall("", CRACKLE_BENCH_PROGRAM) {}
};

TEST_F(BenchCommand, RefusesStudiesAndClaimsItDoesNotKnow) {
    for (const auto& [words, says] :
         {std::pair{"", "usage: crackle-bench STUDY [OPTIONS]"},
          std::pair{"verfy",
                    "crackle-bench: found study 'verfy', expected one of those below, did you mean "
                    "verify?\n"}}) {
        const testing::Answer answer = call(words);
        EXPECT_EQ(answer.code, 2) << words;
        EXPECT_NE(answer.err.find(says), std::string::npos) << answer.err;
        EXPECT_NE(answer.err.find("\n  verify "), std::string::npos) << answer.err;
        EXPECT_EQ(answer.out, "");
    }
    expect_refused("verify --list --only", "crackle-bench verify: the required argument");
    expect_refused("verify --only no_such_claim", "crackle-bench verify: found no claim 'no_such_claim'");
    expect_refused("verify --only two_discs_stacked_between_walls -o nowhere/page.md", "nowhere/page.md");
    expect_refused("verify --no-such-option", "no-such-option");
}

TEST_F(BenchCommand, ListsItsClaims) {
    const testing::Answer answer = call("verify --list");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("two_discs_stacked_between_walls\n"), std::string::npos) << answer.out;
}

TEST_F(BenchCommand, HelpOfEveryStudyHasUsageOptionsAndExamples) {
    const testing::Answer overview = call("--help");
    EXPECT_EQ(overview.code, 0) << overview.err;
    EXPECT_NE(overview.out.find("usage: crackle-bench STUDY [OPTIONS]"), std::string::npos) << overview.out;
    for (const std::string study : {"accuracy", "features", "guide", "stress", "throughput", "verify"}) {
        EXPECT_NE(overview.out.find("\n  " + study + ' '), std::string::npos) << study << '\n' << overview.out;
        const testing::Answer answer = call(study + " --help");
        EXPECT_EQ(answer.code, 0) << study << answer.err;
        for (const std::string& part : {"usage: crackle-bench " + study, std::string("\noptions:\n"),
                                        "\nexamples:\n  crackle-bench " + study, std::string("  -q, --quiet  ")})
            EXPECT_NE(answer.out.find(part), std::string::npos) << study << ": " << part << '\n' << answer.out;
        EXPECT_EQ(call("help " + study).out, answer.out);
    }
}

TEST_F(BenchCommand, QuietSaysNothingAndVerboseSaysMore) {
    const std::string words = "verify --only two_discs_stacked_between_walls -o page.md";
    const testing::Answer usual = call(words), quiet = call(words + " -q"), verbose = call(words + " -v");
    EXPECT_EQ(usual.code, 0) << usual.err;
    EXPECT_EQ(quiet.code, 0) << quiet.err;
    EXPECT_EQ(verbose.code, 0) << verbose.err;
    EXPECT_EQ(quiet.out + quiet.err, "");
    EXPECT_GT(std::count(verbose.err.begin(), verbose.err.end(), '\n'),
              std::count(usual.err.begin(), usual.err.end(), '\n'))
        << verbose.err;
}

TEST_F(BenchCommand, ProgressIsShownOnATerminal) {
    const std::string redraw = "\r\x1b[K";
    for (const auto& [words, says] :
         {std::pair{"verify --only two_discs_stacked_between_walls -o page.md", "two_discs_stacked_between_walls"},
          std::pair{"stress --steps 20", "% "}}) {
        const testing::TerminalAnswer answer =
            testing::call_on_terminal(folder_, words, {}, 120, CRACKLE_BENCH_PROGRAM);
        EXPECT_EQ(answer.code, 0) << answer.shown;
        const std::size_t at = answer.shown.find(redraw);
        ASSERT_NE(at, std::string::npos) << words;
        EXPECT_NE(answer.shown.find(says, at), std::string::npos) << words << '\n' << answer.shown;
    }
}

TEST_F(BenchCommand, ThroughputWritesATableOfEveryKindOfScene) {
    expect_refused("throughput --counts 3", "--counts: found 3, expected 100 to 4000000");
    expect_refused("throughput --repeats 0", "--repeats: found 0");
    expect_refused("throughput --seconds -1", "--seconds: found -1");
    expect_refused("throughput --kinds squares", "--kinds: found 'squares', expected some of circles, voronoi");
    expect_refused("throughput --threads 0", "--threads: found 0, expected 1 to 64");
    const testing::Answer answer = call("throughput --quick --counts 300 --seconds 0.02 -o rates");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out, read("rates/throughput.md"));
    EXPECT_TRUE(exists("rates/throughput.csv"));
    EXPECT_FALSE(exists("rates/scratch"));
    for (const char* row : {"| circles | 305 | 1 |", "| voronoi | 305 | 1 |", "| delaunay | 671 | 1 |",
                            "| coulomb | 305 | 1 |", "| faces | 305 | 1 |", "| pressure | 305 | 1 |"})
        EXPECT_NE(answer.out.find(row), std::string::npos) << row << '\n' << answer.out;
}

TEST_F(BenchCommand, FeaturesWritesBothTablesAndItsPicture) {
    expect_refused("features --count 3", "--count: found 3, expected 100 to 1000000");
    expect_refused("features --pairs 5", "--pairs: found 5, expected 6 to 1000");
    expect_refused("features --seconds 0", "--seconds: found 0");
    const testing::Answer answer = call("features --quick --count 100 --seconds 0.001 -o costs");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out, read("costs/features.md"));
    EXPECT_FALSE(exists("costs/scratch"));
    for (const char* part :
         {"Made by `crackle-bench features --quick --count 100", "Medians of 6 pairs",
          "| discs | normal springs | the same again |", "| discs | clumps of two | bonds |",
          "| hexagons | consistent integrator | friction |", "| voronoi | curve, events, frames of a test | its steps",
          "| discs | bonds | dispatched | kernel compiled without it |", "| hexagons | bonds | forced |",
          "| discs | gravity, turning, controls, profile, threads, losses, breaks, list | dispatched | least step of "
          "springs |"})
        EXPECT_NE(answer.out.find(part), std::string::npos) << part << '\n' << answer.out;
    std::istringstream lines(read("costs/features.csv"));
    std::string line;
    int rows = 0;
    while (std::getline(lines, line)) {
        if (line.starts_with('#') || line.starts_with("kind,")) continue;
        ++rows;
    }
    EXPECT_EQ(rows, 44);
    if (answer.err.find("found no gnuplot") == std::string::npos) {
        EXPECT_NE(read("costs/features.svg").find("<svg"), std::string::npos) << answer.err;
    }
}

TEST_F(BenchCommand, AccuracyWritesATableAndItsPicture) {
    expect_refused("accuracy --only no_such_study", "found no study 'no_such_study', expected one of bounce_energy");
    const testing::Answer answer =
        call("accuracy --quick -o curves --only bounce_energy --only chain_wave --only peak_circles");
    ASSERT_EQ(answer.code, 0) << answer.err;
    std::istringstream lines(read("curves/accuracy.csv"));
    std::map<std::string, double> error;  // keyed by "study integrator parameter value"
    std::string line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("# Made by `crackle-bench accuracy --quick --only bounce_energy")) << line;
    while (std::getline(lines, line)) {
        if (line.starts_with('#') || line.starts_with("study,")) continue;
        std::vector<std::string> words;
        std::istringstream cells(line);
        for (std::string word; std::getline(cells, word, ',');) words.push_back(word);
        ASSERT_EQ(words.size(), 7u) << line;
        EXPECT_GT(std::stod(words[5]), 0.0) << line;
        error[words[0] + ' ' + words[2] + ' ' + words[3] + ' ' + words[4]] = std::stod(words[6]);
    }
    EXPECT_EQ(error.size(), 21u);
    EXPECT_LT(error.at("bounce_energy consistent time_step 0.2"), 1e-9);
    EXPECT_GT(error.at("bounce_energy leapfrog time_step 0.2"), 1e-4);
    // The error is of second order in the step.
    EXPECT_NEAR(error.at("chain_wave leapfrog time_step 0.4") / error.at("chain_wave leapfrog time_step 0.2"), 4.0,
                0.5);
    EXPECT_LT(error.at("peak_circles leapfrog time_step 0.4"), 0.5);
    EXPECT_LT(error.at("peak_circles leapfrog rate_tolerance 0.05"), 0.5);
    EXPECT_NE(read("curves/accuracy.gp").find("plot $bounce_energy_0"), std::string::npos);
    // Without gnuplot the message says so, and the table is still written.
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
    EXPECT_TRUE(page.starts_with("# Verification\n\nMade by `crackle-bench verify -o page.md --only bond_squeezed_to"))
        << page;
    for (const char* part : {"| claim | rows | largest error / tolerance | verdict |", "\n## Bonds\n",
                             "\n### bond_squeezed_to_ten_times_its_strength_holds\n",
                             "| row | expected | got | error | tolerance | order (expected) | verdict |",
                             "| squeezing force over strength | 10 | 10 |", "| holds |", "| not offered |",
                             "2 claims; 4 rows hold, 0 fail, 0 are only reported, 4 belong to options"})
        EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
    EXPECT_EQ(page.find("FAILS"), std::string::npos) << page;
    // Every row of a table has as many columns as its heading.
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

TEST_F(BenchCommand, StressShowsEveryScene) {
    expect_refused("stress --steps 0", "--steps: found 0, expected at least 1");
    const testing::Answer answer = call("stress --steps 20");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_NE(answer.out.find("| needles of 1 to 1000 | 36 | 20 |"), std::string::npos) << answer.out;
    EXPECT_EQ(answer.out.find("FAILS"), std::string::npos) << answer.out;
}

TEST_F(BenchCommand, PrintsThePageWhereNoFileIsGiven) {
    const testing::Answer answer = call("verify --only two_discs_stacked_between_walls");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.out.starts_with("# Verification\n")) << answer.out;
    EXPECT_NE(answer.out.find("2.00 (2)"), std::string::npos) << "order of convergence\n" << answer.out;
}

TEST_F(BenchCommand, RefusesEnsemblesOfTheGuideThatMakeNoSense) {
    expect_refused("guide --laws rounded hertz", "--laws: found 'hertz'");
    expect_refused("guide --laws rounded rounded", "found 'rounded' twice");
    expect_refused("guide --packings 0", "--packings: found 0");
    expect_refused("guide --packings 2 --strength-packings 3", "--strength-packings: found 3, expected 0 to 2");
    expect_refused("guide --strength-packings 1 1 1 1", "found 4 numbers, expected at most 3");
    expect_refused("guide --experiments nonsense", "--experiments: found 'nonsense', expected some of shipped, ");
    expect_refused("guide --rate-factor 0", "--rate-factor: found 0");
    expect_refused("guide --jobs 0", "--jobs: found 0");
    expect_refused("guide --quick --cases nowhere", "circles_tension.toml");
}

TEST_F(BenchCommand, QuickEnsembleOfTheGuideHasItsElasticRowsAndGoesOnFromItsCache) {
    const std::string words =
        std::string("guide --quick --cases '") + CRACKLE_SOURCE_DIR + "/specimens/guide_rock' -o ";
    const testing::Answer answer = call(words + "guide");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.err.empty()) << "no progress without a terminal\n" << answer.err;
    const std::string page = read("guide/guide.md");
    EXPECT_EQ(answer.out, page);
    EXPECT_TRUE(page.starts_with("# The guide's rock, as an ensemble\n\nMade by `crackle-bench guide --quick")) << page;
    for (const char* part :
         {"| what | the guide | rounded: ours | verdict | demseg: ours | verdict | demseg_mean: ours | verdict |",
          // The packing is compressed to exactly this mean overlap.
          "| mean back-tension, circles, kN | 0.774 | 0.774 ±", "| triangles | 537 |", "| about √10 |",
          "| circles' tensile strength over 19.4 kN/m | about 1/4 | – | – |", "(2) | inside |",
          "(2) | **outside**, +27 % |", "No experiment has been run for it."})
        EXPECT_NE(page.find(part), std::string::npos) << part << '\n' << page;
    EXPECT_EQ(page.find("no result"), std::string::npos) << page;

    const std::string csv = read("guide/guide.csv");
    for (const char* part :
         {"seed,experiment,law,quantity,unit,value\n", "\n2,shipped,demseg_mean,delaunay_contacts,-,",
          "\n1,shipped,rounded,circles.elastic.youngs_modulus,N/m,"})
        EXPECT_NE(csv.find(part), std::string::npos) << part;

    // Run times would differ if a test were run again, so equal bytes show that the cache was used.
    ASSERT_EQ(call(words + "guide --jobs 1").code, 0);
    EXPECT_EQ(read("guide/guide.csv"), csv);
    std::filesystem::remove(folder_ / "guide/cache/shipped_demseg_voronoi_elastic_2.json");
    ASSERT_EQ(call(words + "guide --minutes 0").code, 0);
    EXPECT_NE(read("guide/guide.md").find("1 tests of this plan have not been run yet"), std::string::npos);
}

}  // namespace
}  // namespace crackle
