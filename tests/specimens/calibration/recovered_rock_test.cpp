// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a rock with known keys that is measured on its own packings and calibrated only from these results. Also tests
// targets that cannot be reached, and calibrations that are stopped. Each takes several hundred tests.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/files/read_file.hpp"
#include "specimens/calibration/outcome_files.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/making/hooks.hpp"
#include "tests/specimens/calibration/known_rock.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using RecoveredRock = testing::KnownRock;
using testing::agrees;
using testing::target_text;
using testing::true_cohesion;
using testing::true_modulus;
using testing::true_ratio;
using testing::true_tensile;
using testing::write_circles_rock;

TEST_F(RecoveredRock, HasItsKeysWithinTheStatedIntervals) {
    write_circles_rock(folder_, true_modulus, true_ratio, true_tensile, true_cohesion, 150);
    const Rock rock = rock_of(measured_targets(16) + testing::elastic_keys + testing::strength_keys, 8, 24, 12);
    const CalibrationOutcome outcome = calibrated(rock);
    fmt::print("{}", calibration_text(rock, outcome));
    // The means over fresh, fitted and measured packings all have a standard error.
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const ReachedTarget& t = outcome.targets[k];
        const double error = std::hypot(t.fresh.standard_error / t.fresh.mean, t.polish.standard_error / t.polish.mean,
                                        rock.targets[k].error);
        EXPECT_LE(std::abs(t.off), 3.0 * error) << rock.targets[k].name(rock.tests);
    }
    const std::vector<double> truth{true_modulus, true_ratio, true_tensile, true_cohesion};
    for (std::size_t k = 0; k < truth.size(); ++k) {
        EXPECT_TRUE(outcome.keys[k].determined) << rock.free[k].name();
        EXPECT_LE(outcome.keys[k].low, truth[k]) << rock.free[k].name();
        EXPECT_GE(outcome.keys[k].high, truth[k]) << rock.free[k].name();
    }
    // The cases that it writes must be read back with the values found.
    write_calibration(rock, outcome, folder_ / "out");
    const ResolvedCase back = read_case(folder_ / "out" / "cases" / "tension.toml");
    EXPECT_TRUE(agrees("tensile strength of the case", *back.material.tensile_strength, outcome.keys[2].value, 1e-12));
    const auto json = nlohmann::json::parse(read_file(folder_ / "out" / "calibration.json"));
    EXPECT_EQ(json["targets"].size(), 4U);
    EXPECT_EQ(json["keys"][2]["value"].get<double>(), outcome.keys[2].value);
}

TEST_F(RecoveredRock, StoppedAtAnyTestItGoesOnToTheSameBytes) {
    const Rock rock = rock_of(target_text("compression", "peak_stress", 3e7) +
                              target_text("tension", "peak_stress", 6e6) + testing::strength_keys);
    const std::string undisturbed = calibration_json(rock, calibrated(rock, "undisturbed")).dump();
    int stops = 0;
    for (int more = 3;; more += 14) {
        int ended = 0;
        CalibrationHooks hooks;
        hooks.progress = [&](const std::string&, const CampaignProgress&) { ++ended; };
        hooks.interrupted = [&] { return ended > more; };
        try {
            CalibrationOutcome outcome = calibrate(rock, {.folder = folder_ / "out", .workers = 2}, hooks);
            auto json = calibration_json(rock, outcome), whole = nlohmann::ordered_json::parse(undisturbed);
            json.erase("processor_seconds");
            whole.erase("processor_seconds");
            EXPECT_EQ(json.dump(), whole.dump());
            break;
        } catch (const TestInterrupted&) {
            ++stops;
        }
    }
    fmt::print("  stopped {} times\n", stops);
    EXPECT_GE(stops, 2);
}

TEST_F(RecoveredRock, WhatIsOutOfReachIsToldWithItsFrontier) {
    // Within these bounds, circles cannot reach a ratio of 60 between compressive and tensile strength.
    const Rock rock = rock_of(target_text("compression", "peak_stress", 3e8) +
                              target_text("tension", "peak_stress", 5e6) + testing::strength_keys);
    const CalibrationOutcome outcome = calibrated(rock);
    const std::string text = calibration_text(rock, outcome);
    fmt::print("{}", text);
    EXPECT_FALSE(outcome.all_reached());
    ASSERT_EQ(outcome.targets[outcome.frontier_of].verdict, TargetVerdict::out_of_reach);
    EXPECT_NE(text.find("cannot be met together with the other targets; the nearest value reached is"),
              std::string::npos);
    ASSERT_GE(outcome.frontier.size(), 3U);
    const auto& first = outcome.frontier.front();
    const auto& last = outcome.frontier.back();
    // The larger the weight of the missed target, the closer it is approached, and the larger the error of the other.
    const std::size_t missed = outcome.frontier_of, other = 1 - missed;
    const auto off = [&](const FrontierPoint& point, std::size_t t) {
        return std::abs(std::log(point.figures[t].mean / rock.targets[t].value));
    };
    EXPECT_LT(off(last, missed), off(first, missed));
    EXPECT_GT(off(last, other), off(first, other));
}

}  // namespace
}  // namespace crackle
