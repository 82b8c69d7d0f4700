// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle joints` as called by a user: the report, its JSON, the figure and the table of traces, and refusals.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/claim.hpp"
#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::Answer;

class CrackleJoints : public testing::ProgramCall {
  protected:
    CrackleJoints() : ProgramCall("joints") {
        write("joints.toml",
              "[packing]\nwidth = 1.0\nheight = 2.0\n[[joint_set]]\nname = \"bedding\"\nangle = 10.0\nspacing = 0.2\n"
              "[[joint_set]]\nname = \"cross joints\"\norientation = \"von_mises\"\nangle = 100.0\nkappa = 30.0\n"
              "length = \"exponential\"\nlength_mean = 0.2\np21 = 4.0\n");
    }
};

TEST_F(CrackleJoints, ReportsWhatWasAskedBesideWhatWasReached) {
    const Answer answer = call("joints.toml");
    ASSERT_EQ(answer.code, 0) << answer.err;
    for (const char* text : {"box 1 m x 2 m", "bedding", "cross joints", "P21          4 (requested 4) m/m2",
                             "(requested 30)", "P10          ", "(requested 5)", "blocks "})
        EXPECT_NE(answer.out.find(text), std::string::npos) << text << '\n' << answer.out;
    write("short.toml",
          "[packing]\nwidth = 1.0\nheight = 2.0\n[joints]\nshortest = 0.3\n[[trace]]\npoints = [0.0, 0.0, 0.1, 0.1]\n"
          "[[trace]]\npoints = [0.0, 1.0, 0.9, 1.1]\n");
    EXPECT_NE(call("short.toml").out.find("notice: 1 traces shorter than 0.3 m"), std::string::npos);
    for (const char* file : {"joints.toml", "short.toml"}) EXPECT_EQ(call(fmt::format("{} -q", file)).out, "");
}

TEST_F(CrackleJoints, JsonHasTheSameAndTheTableIsReadAgain) {
    const Answer first = call("joints.toml --json --traces traces.txt");
    ASSERT_EQ(first.code, 0) << first.err;
    const auto json = nlohmann::json::parse(first.out);
    EXPECT_TRUE(agrees("P21", json["sources"][1]["p21"].get<double>(), 4.0, 1e-9));
    EXPECT_EQ(json["sources"][0]["asked"]["p10"], 5.0);
    EXPECT_TRUE(json["sources"][0]["kappa"].is_null());
    write("again.toml", "[packing]\nwidth = 1.0\nheight = 2.0\n[[trace]]\nfile = \"traces.txt\"\n");
    const Answer again = call("again.toml --json --traces once_more.txt");
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(read("traces.txt"), read("once_more.txt"));
    const auto measured = nlohmann::json::parse(again.out);
    EXPECT_EQ(measured["all"]["p21"], json["all"]["p21"]);
    EXPECT_EQ(measured["blocks"], json["blocks"]);
}

TEST_F(CrackleJoints, TheSameSeedGivesTheSameBytes) {
    ASSERT_EQ(call("joints.toml --traces a.txt -o a.svg").code, 0);
    ASSERT_EQ(call("joints.toml --traces b.txt -o b.svg").code, 0);
    ASSERT_EQ(call("joints.toml --seed 9 --traces c.txt").code, 0);
    EXPECT_EQ(read("a.txt"), read("b.txt"));
    EXPECT_EQ(read("a.svg"), read("b.svg"));
    EXPECT_NE(read("a.txt"), read("c.txt"));
}

TEST_F(CrackleJoints, FiguresAreOfTheFormatTheirNameSays) {
    for (const auto& [name, begins] : {std::pair{"f.svg", "<?xml"}, {"f.pdf", "%PDF"}, {"f.png", "\x89PNG"}}) {
        ASSERT_EQ(call(fmt::format("joints.toml -o {}", name)).code, 0);
        EXPECT_TRUE(read(name).starts_with(begins)) << name;
    }
}

TEST_F(CrackleJoints, ASurveyIsCleanedByTheGrainOrSnapThatIsGiven) {
    write("survey.txt", "0.1 0.5 0.5 0.7\n0.5 0.7 0.9 0.6\n0.3 0.2 0.3 0.2\n0.7 0.1 0.5 0.70001 0.4 1.5\n");
    const std::string box = "[packing]\nwidth = 1.0\nheight = 2.0\n", trace = "[[trace]]\nfile = \"survey.txt\"\n";
    write("plain.toml", box + trace);
    write("snap.toml", box + "[joints]\nsnap = 0.01\n" + trace);
    const Answer plain = call("plain.toml");
    ASSERT_EQ(plain.code, 0) << plain.err;
    EXPECT_NE(plain.out.find("  traces       3\n"), std::string::npos) << plain.out;
    EXPECT_NE(plain.out.find("notice: survey: 1 of 4 traces has no length and is passed over, the first at "
                             "survey.txt:3"),
              std::string::npos)
        << plain.out;
    EXPECT_EQ(plain.out.find("snap"), std::string::npos) << plain.out;
    for (const char* words : {"snap.toml", "plain.toml --grain 0.05"}) {
        const Answer answer = call(words);
        ASSERT_EQ(answer.code, 0) << answer.err;
        for (const char* text : {"  traces       2\n", "joints: snap = 0.01 m", "none moved further than 3.16e-06 m",
                                 "notice: survey: 2 rows that share nodes are 1 trace from end to end"})
            EXPECT_NE(answer.out.find(text), std::string::npos) << text << '\n' << answer.out;
        const auto json = nlohmann::json::parse(call(std::string(words) + " --json").out);
        EXPECT_TRUE(agrees("snap", json["snap"].get<double>(), 0.01, 1e-12));
        EXPECT_EQ(json["brought_together"], 1)
            << "the point at a distance of 1e-5 m from the node of the first two rows";
        EXPECT_EQ(json["points_left_out"], 0) << "each row turns at its points";
        EXPECT_TRUE(
            testing::within("largest displacement", json["largest_displacement"].get<double>(), 3.1622e-6, 1e-9));
    }
    expect_refused("plain.toml --grain 0", "--grain: found 0");
    expect_refused("plain.toml --grain 50", "grains in the box");
}

TEST_F(CrackleJoints, RefusesWhatItCannotUse) {
    write("traces.txt", "kept");
    expect_refused("joints.toml --traces traces.txt", "traces.txt");
    expect_refused("", "expected one: crackle joints CASE.toml");
    expect_refused("joints.toml -o f.gif", "f.gif");
    expect_refused("joints.toml --seed -1", "expected a whole number >= 0");
    write("none.toml", "[packing]\nwidth = 1.0\n");
    expect_refused("none.toml", "found no [[joint_set]] and no [[trace]]");
    write("boxless.toml", "[[trace]]\npoints = [0.0, 0.0, 1.0, 1.0]\n");
    expect_refused("boxless.toml", "give --box-width");
    expect_refused("boxless.toml --box-width 0", "--box-width: found 0");
    EXPECT_EQ(call("boxless.toml --box-width 2 --box-height 1").code, 0);
    write("wrong.toml", "[[trace]]\npoints = [0.0, 0.0, 1.0]\n");
    expect_refused("wrong.toml --box-width 1 --box-height 1", "wrong.toml:2: trace[1].points: found 3 numbers");
}

}  // namespace
}  // namespace crackle
