// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle run` as called by a user: exit codes, outputs, and an interrupt without loss.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/interrupted_call.hpp"

namespace crackle {
namespace {

using namespace testing;

class RunCommand : public ::testing::Test {
  protected:
    /// Runs crackle and returns its exit code; stdout and stderr go to `printed()`.
    int crackle(const std::string& words) const {
        const std::string line =
            fmt::format("'{}' {} > '{}' 2>&1", CRACKLE_PROGRAM, words, (scratch_ / "printed").string());
        return WEXITSTATUS(std::system(line.c_str()));
    }
    std::string printed() const { return read_file(scratch_ / "printed"); }
    std::string quoted(const std::filesystem::path& path) const { return fmt::format("'{}'", path.string()); }

    ScratchFolder scratch_;
};

TEST_F(RunCommand, WritesEveryOutputOfTheGuide) {
    const auto out = scratch_ / "out";
    ASSERT_EQ(crackle(fmt::format("run {} -o {}", quoted(shipped_deck("controlled_segment_force")), quoted(out))), 0)
        << printed();
    for (const char* name :
         {"output.dat", "cont.dat", "cont2.dat", "energy.dat", "f-d_curve.dat", "velocity_y.dat", "bonds.dat",
          "events.csv", "new_in_gm.dat", "new_in_bc.dat", "new_in_cf.dat", "new_in_cf0.dat", "new_state.bin"}) {
        EXPECT_TRUE(std::filesystem::exists(out / name)) << name;
    }
    EXPECT_EQ(printed().find('\r'), std::string::npos) << "no progress line where there is no terminal";
}

TEST_F(RunCommand, TheGuidesLawIsAnOptionThatARunKeeps) {
    const std::string deck = quoted(shipped_deck("triangle"));
    const auto energy = [&](const char* folder) { return read_file(scratch_ / folder / "energy.dat"); };
    const auto run = [&](const std::string& what, const char* folder) {
        return crackle(fmt::format("run -q {} -o {}", what, quoted(scratch_ / folder)));
    };
    ASSERT_EQ(run(deck, "plain"), 0) << printed();
    ASSERT_EQ(run(deck + " --law rounded", "rounded"), 0) << printed();
    ASSERT_EQ(run(deck + " --law demseg", "demseg"), 0) << printed();
    EXPECT_EQ(energy("plain"), energy("rounded"));
    EXPECT_EQ(energy("plain"), energy("demseg")) << "a body among walls alone: walls are the same in both";
    EXPECT_EQ(run(deck + " --law square", "out"), 2);
    EXPECT_NE(printed().find("--law: found \"square\", expected \"rounded\", \"demseg\" or \"demseg_mean\""),
              std::string::npos)
        << printed();

    // Two segments, one of which hits the end of the other, where the laws differ.
    const auto two = scratch_ / "two";
    std::filesystem::create_directories(two);
    std::ofstream(two / "in_gm.dat") << "1 0 0\n1e-5 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0.1\n0 2 0\n"
                                        "1 1 1\n0 0 0\n1 0 0\n5 0\n2 1 1\n0 -50 0\n1 4.95 0.11\n8 0.5\n";
    std::ofstream(two / "in_bc.dat") << "0 0 400 100 10\n0\n0\n";
    ASSERT_EQ(run(quoted(two), "a"), 0) << printed();
    ASSERT_EQ(run(quoted(two) + " --law demseg", "b"), 0) << printed();
    EXPECT_NE(energy("a"), energy("b"));
    ASSERT_EQ(run(quoted(two) + " --law demseg --steps 133", "part"), 0) << printed();
    ASSERT_EQ(run(quoted(scratch_ / "part") + " --continue", "rest"), 0) << printed();
    EXPECT_EQ(energy("part") + energy("rest"), energy("b")) << "the law of the first run is kept";
    EXPECT_EQ(run(quoted(scratch_ / "part") + " --continue --law rounded", "other"), 2);
    EXPECT_NE(printed().find("--law: found rounded, expected demseg, as recorded "), std::string::npos) << printed();
}

TEST_F(RunCommand, TheIntegratorIsAnOptionThatARunKeeps) {
    const std::string deck = quoted(shipped_deck("circle"));
    const auto energy = [&](const char* folder) { return read_file(scratch_ / folder / "energy.dat"); };
    const auto run = [&](const std::string& what, const char* folder) {
        return crackle(fmt::format("run -q {} -o {}", what, quoted(scratch_ / folder)));
    };
    ASSERT_EQ(run(deck, "plain"), 0) << printed();
    ASSERT_EQ(run(deck + " --integrator leapfrog", "leapfrog"), 0) << printed();
    ASSERT_EQ(run(deck + " --integrator consistent", "consistent"), 0) << printed();
    EXPECT_EQ(energy("plain"), energy("leapfrog"));
    EXPECT_NE(energy("plain"), energy("consistent"));
    ASSERT_EQ(run(deck + " --integrator consistent --steps 7777", "part"), 0) << printed();
    ASSERT_EQ(run(quoted(scratch_ / "part") + " --continue", "rest"), 0) << printed();
    EXPECT_TRUE(energy("consistent").ends_with(energy("rest"))) << "the integrator of the first run is kept";
    EXPECT_EQ(run(quoted(scratch_ / "part") + " --continue --integrator leapfrog", "other"), 2);
    EXPECT_NE(printed().find("--integrator: found leapfrog, expected consistent, as recorded "), std::string::npos)
        << printed();
    EXPECT_EQ(run(deck + " --integrator euler", "out"), 2);
    EXPECT_NE(printed().find("--integrator: found \"euler\", expected \"leapfrog\" or \"consistent\""),
              std::string::npos)
        << printed();
}

TEST_F(RunCommand, BadInputEndsInOneMessageAndCode2) {
    const auto deck = scratch_ / "deck";
    std::filesystem::create_directories(deck);
    EXPECT_EQ(crackle("run " + quoted(scratch_ / "nowhere")), 2);
    EXPECT_NE(printed().find("nowhere: found no such folder"), std::string::npos) << printed();
    EXPECT_EQ(crackle("run " + quoted(deck)), 2);
    EXPECT_NE(printed().find("in_gm.dat: cannot be read (No such file or directory)"), std::string::npos) << printed();
    std::filesystem::copy_file(shipped_deck("circle") / "in_bc.dat", deck / "in_bc.dat");
    const std::string geometry = read_file(shipped_deck("circle") / "in_gm.dat");
    std::ofstream(deck / "in_gm.dat") << geometry.substr(0, geometry.size() / 2);
    EXPECT_EQ(crackle("run " + quoted(deck)), 2);
    EXPECT_NE(printed().find("found the end of the file"), std::string::npos) << printed();
    std::ofstream(deck / "in_gm.dat") << geometry;
    EXPECT_EQ(crackle("run --threads 0 " + quoted(deck)), 2);
    EXPECT_EQ(crackle("run --no-such-option " + quoted(deck)), 2);
    EXPECT_EQ(crackle("run"), 2);
    EXPECT_FALSE(std::filesystem::exists(deck / "energy.dat"));
    EXPECT_EQ(crackle("run " + quoted(deck)), 0) << printed();
    EXPECT_EQ(crackle("run " + quoted(deck)), 2);
    EXPECT_NE(printed().find("--force"), std::string::npos) << printed();
}

TEST_F(RunCommand, AStepAboveTheBoundNeedsAllowUnstable) {
    const auto deck = scratch_ / "deck";
    std::filesystem::create_directories(deck);
    std::ofstream(deck / "in_bc.dat") << "0 0 200 100 10\n0\n0\n";
    std::string geometry = read_file(shipped_deck("circle") / "in_gm.dat");
    std::ofstream(deck / "in_gm.dat") << geometry.replace(geometry.find("5.0d-5"), 6, "1.2d-3");
    EXPECT_EQ(crackle("run " + quoted(deck)), 2);
    EXPECT_NE(printed().find("0.0012"), std::string::npos) << printed();
    EXPECT_NE(printed().find("0.00112"), std::string::npos) << "states the bound too: " << printed();
    EXPECT_EQ(crackle("run --allow-unstable " + quoted(deck)), 0) << printed();
}

TEST_F(RunCommand, NoticesOfTheSceneArePrinted) {
    const auto deck = scratch_ / "deck";
    std::filesystem::create_directories(deck);
    std::ofstream(deck / "in_gm.dat") << "1 0 0\n1e-5 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0\n0 2 0\n"
                                         "1 1 1\n0 0 0\n1 0 0\n5 0\n2 1 1\n0 0 0\n1 0 1\n5 1\n";
    std::ofstream(deck / "in_bc.dat") << "0 0 10 10 10\n0\n0\n";
    EXPECT_EQ(crackle("run " + quoted(deck)), 0) << printed();
    EXPECT_NE(printed().find("thick: at a thickness of 0"), std::string::npos) << printed();
    EXPECT_EQ(crackle("run --quiet --force " + quoted(deck)), 0);
    EXPECT_EQ(printed(), "");
}

TEST_F(RunCommand, AStepThatThePileOutgrowsEndsInCode3) {
    const auto deck = scratch_ / "deck";
    std::filesystem::create_directories(deck);
    std::ofstream(deck / "in_gm.dat") << "1 0 0\n0.9e-3 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0\n2 0 0\n"
                                         "1 1 1\n1 0 0\n1 2\n-2.125 0 0\n2 1 1\n-1 0 0\n1 2\n2.125 0 0\n";
    std::ofstream(deck / "in_bc.dat") << "0 0 200 100 10\n0\n0\n";
    EXPECT_EQ(crackle("run " + quoted(deck)), 3) << printed();
    EXPECT_NE(printed().find("0.0009 s, is above the stable bound"), std::string::npos) << printed();
    EXPECT_EQ(crackle("run --force --allow-unstable " + quoted(deck)), 0) << printed();
}

TEST_F(RunCommand, AnInterruptedRunGoesOnAsIfNothingHadHappened) {
    const std::string deck = shipped_deck("chain_hanging").string(), out = (scratch_ / "out").string(),
                      whole = (scratch_ / "whole").string();
    ASSERT_EQ(crackle(fmt::format("run -q '{}' -o '{}'", deck, whole)), 0) << printed();
    const auto begun = std::filesystem::path(out) / "velocity_y.dat";  // the last file to be opened
    ASSERT_EQ(testing::interrupted_call(scratch_ / "", {"run", "-q", deck, "-o", out}, SIGINT,
                                        [&] { return std::filesystem::exists(begun); }),
              130);
    ASSERT_EQ(crackle(fmt::format("run -q '{}' --continue", out)), 0) << printed();
    for (const char* name :
         {"output.dat", "cont.dat", "energy.dat", "f-d_curve.dat", "new_in_gm.dat", "new_in_bc.dat", "new_state.bin"}) {
        EXPECT_TRUE(read_file(std::filesystem::path(out) / name) == read_file(std::filesystem::path(whole) / name))
            << name;
    }
}

}  // namespace
}  // namespace crackle
