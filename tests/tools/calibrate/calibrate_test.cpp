// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle calibrate` as called by a user.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <cmath>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/support/interrupted_call.hpp"
#include "tests/support/killed_workers.hpp"
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
    const std::string before = read("out/calibration.json"), page = read("out/calibration.html");
    const auto json = nlohmann::json::parse(before);
    for (const auto& target : json["targets"]) {
        const auto number = [&](const char* key) { return target[key].get<double>(); };
        // The page shows moduli and strengths with SI prefixes.
        const double unit = number("value") < 1.0 ? 1.0 : std::pow(1e3, std::floor(std::log10(number("value")) / 3.0));
        const auto fresh = [&](const char* key) { return target["fresh"][key].get<double>() / unit; };
        const std::string row =
            fmt::format("<td>{:.4g}</td><td>{:.4g} ± {:.2g}</td><td>{:.2g}</td><td>{:+.1f}</td><td>{:.1f}</td>",
                        number("value") / unit, fresh("mean"), fresh("standard_error"), fresh("deviation"),
                        100.0 * number("off"), 100.0 * number("limit"));
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
    for (const auto& key : json["keys"]) {
        const std::string row =
            fmt::format("<td>{}</td><td>{:.5g}</td><td>{:.4g} to {:.4g}</td><td>{:.4g} to {:.4g}",
                        key["key"].get<std::string>(), key["value"].get<double>(), key["interval"][0].get<double>(),
                        key["interval"][1].get<double>(), key["from"].get<double>(), key["to"].get<double>());
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(call("rock.toml -o out -q").out, "") << "no output, and no test is repeated";
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
    expect_refused("rock.toml -o held", ", expected a new or empty folder, or the folder of a calibration");
}

TEST_F(CalibrateCommand, AnInterruptIsGoneOnFrom) {
    write_rock(target_text("compression", "peak_stress", 3e7) + target_text("tension", "peak_stress", 6e6) +
               testing::strength_keys);
    const auto begun = [&] { return exists("out/search/campaign.sqlite"); };
    ASSERT_EQ(testing::interrupted_call(folder_, {"calibrate", "rock.toml", "-o", "out"}, SIGINT, begun), 130);
    EXPECT_NE(read("err.txt").find("interrupted; run the same command again to resume"), std::string::npos)
        << read("err.txt");
    EXPECT_FALSE(exists("out/calibration.json"));
    EXPECT_NE(call("rock.toml -o out").code, 130);
    EXPECT_TRUE(exists("out/calibration.json"));
}

// A test that ended with a system error has no figures, and a mean without it would be that of another rock.
TEST_F(CalibrateCommand, WithoutATestThatTheSystemEndedNothingIsCalibrated) {
    write_rock(target_text("compression", "peak_stress", 3e7) + target_text("tension", "peak_stress", 6e6) +
               testing::strength_keys);
    const int undisturbed = call("rock.toml -o whole").code;
    const pid_t process = testing::started_call(folder_, {"calibrate", "rock.toml", "-o", "out", "--workers", "1"});
    testing::kill_workers(process, 8);  // four that make packings, and three that run the same test
    EXPECT_EQ(testing::ended_call(process), 4) << read("err.txt");
    EXPECT_NE(read("err.txt").find("expected figures of all packings; the same command runs what is missing"),
              std::string::npos)
        << read("err.txt");
    EXPECT_FALSE(exists("out/calibration.json"));
    EXPECT_EQ(call("rock.toml -o out").code, undisturbed) << read("err.txt");
    EXPECT_EQ(read("out/rock.toml"), read("whole/rock.toml"));
}

TEST_F(CalibrateCommand, ATestThatCrashesTwiceIsNamedAndTheOthersAreKept) {
    write_rock(target_text("compression", "peak_stress", 3e7) + target_text("tension", "peak_stress", 6e6) +
               testing::strength_keys);
    const pid_t process = testing::started_call(folder_, {"calibrate", "rock.toml", "-o", "out", "--workers", "1"});
    testing::kill_workers(process, 6, SIGABRT);  // four that make packings, and two that run the same test
    EXPECT_EQ(testing::ended_call(process), 4) << read("err.txt");
    EXPECT_TRUE(std::regex_search(
        read("err.txt"),
        std::regex(
            R"(1 test failed because of the system \((compression|tension), .*, seed \d+: crashed: its process was )"
            R"(ended by signal 6 \(Aborted\) in each of 2 tries)")))
        << read("err.txt");
    EXPECT_NE(call("rock.toml -o out").code, 4) << read("err.txt");
}

TEST_F(CalibrateCommand, ALinearSolveThatTheSystemEndedIsNoRefusal) {
    const pid_t process = testing::started_call(folder_, {"calibrate", "rock.toml", "-o", "out", "--workers", "1"});
    testing::kill_workers(process, 1);
    EXPECT_EQ(testing::ended_call(process), 4) << read("err.txt");
    EXPECT_TRUE(std::regex_search(read("err.txt"),
                                  std::regex(R"(a linear solve failed because of the system: \w+, seed \d+: its )"
                                             R"(process was ended by signal 9 \(Killed\);)")))
        << read("err.txt");
    const Answer again = call("rock.toml -o out");
    EXPECT_EQ(again.code, again.out.find("2 of 2 targets reached") != std::string::npos ? 0 : 1) << again.err;
}

TEST_F(CalibrateCommand, ListsTheKeysOfARock) {
    const Answer answer = call("--keys");
    EXPECT_EQ(answer.code, 0);
    for (const char* key : {"[[test]]", "[[target]]", "[[free]]", "[[curve]]", "[packings]", "polish"})
        EXPECT_NE(answer.out.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace crackle
