// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle calibrate` as a user calls it.

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "tests/support/interrupted_call.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_circles_rock.hpp"

namespace crackle {
namespace {

using testing::Answer;
using testing::target_text;

class CalibrateCommand : public testing::ProgramCall {
  protected:
    CalibrateCommand() : ProgramCall("calibrate") {
        testing::write_circles_rock(folder_);
        write_rock(target_text("compression", "youngs_modulus", 1.4e10) +
                   target_text("compression", "poissons_ratio", 0.25) + testing::elastic_keys);
    }
    void write_rock(const std::string& text) const {
        write("rock.toml", "title = \"Small circles\"\n" + std::string(testing::circles_tests) + text +
                               "[packings]\nfit = 4\npolish = 4\nfresh = 4\n");
    }
};

TEST_F(CalibrateCommand, EndsWithCasesATableAndItsKeys) {
    const Answer answer = call("rock.toml -o out");
    EXPECT_EQ(answer.err.find('\r'), std::string::npos) << "no progress line in a pipe";
    EXPECT_NE(answer.out.find("Small circles: "), std::string::npos) << answer.out;
    EXPECT_EQ(answer.code, answer.out.find("2 of 2 targets reached") != std::string::npos ? 0 : 1) << answer.out;
    for (const char* file : {"cases/compression.toml", "cases/tension.toml", "rock.toml", "calibration.json",
                             "calibration.txt", "calibration.html"})
        EXPECT_TRUE(exists(std::string("out/") + file)) << file;
    EXPECT_NE(read("out/rock.toml").find("[material]\ncontact_modulus = "), std::string::npos) << read("out/rock.toml");
    const std::string before = read("out/calibration.json");
    EXPECT_EQ(call("rock.toml -o out -q").out, "") << "quiet, and nothing is run again";
    EXPECT_EQ(read("out/calibration.json"), before);
}

TEST_F(CalibrateCommand, ExitCode1SaysThatATargetIsMissed) {
    write_rock(target_text("compression", "poissons_ratio", 0.9) + testing::elastic_keys);
    const Answer answer = call("rock.toml -o out");
    EXPECT_EQ(answer.code, 1) << answer.err;
    EXPECT_NE(answer.out.find("out of reach"), std::string::npos) << answer.out;
}

TEST_F(CalibrateCommand, DryRunSaysWhatItWouldDoAndWritesNothing) {
    const auto before = snapshot();
    const Answer answer = call("rock.toml --dry-run");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("Small circles: 2 targets, 2 free keys, 2 tests"), std::string::npos) << answer.out;
    EXPECT_TRUE(snapshot() == before);
}

TEST_F(CalibrateCommand, RefusesWithOneLine) {
    expect_refused("", "found no ROCK.toml");
    expect_refused("rock.toml", "found no -o");
    expect_refused("none.toml -o out", "found no such file");
    expect_refused("rock.toml -o out --workers 0", "--workers: found 0");
    std::filesystem::create_directory(folder_ / "held");
    write("held/file", "mine");
    expect_refused("rock.toml -o held", "found files that no calibration made");
}

TEST_F(CalibrateCommand, AnInterruptIsGoneOnFrom) {
    write_rock(target_text("compression", "peak_stress", 3e7) + target_text("tension", "peak_stress", 6e6) +
               testing::strength_keys);
    const auto begun = [&] { return exists("out/search/campaign.sqlite"); };
    ASSERT_EQ(testing::interrupted_call(folder_, {"calibrate", "rock.toml", "-o", "out"}, SIGINT, begun), 130);
    EXPECT_NE(read("err.txt").find("interrupted; the same command goes on"), std::string::npos) << read("err.txt");
    EXPECT_FALSE(exists("out/calibration.json"));
    EXPECT_NE(call("rock.toml -o out").code, 130);
    EXPECT_TRUE(exists("out/calibration.json"));
}

TEST_F(CalibrateCommand, ListsTheKeysOfARock) {
    const Answer answer = call("--keys");
    EXPECT_EQ(answer.code, 0);
    for (const char* key : {"[[test]]", "[[target]]", "[[free]]", "[[curve]]", "[packings]", "polish"})
        EXPECT_NE(answer.out.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace crackle
