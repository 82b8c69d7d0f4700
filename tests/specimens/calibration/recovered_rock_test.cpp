// SPDX-License-Identifier: GPL-3.0-or-later
// A rock with known keys, measured on packings of its own and calibrated from these numbers alone.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "solver/files/read_file.hpp"
#include "specimens/calibration/outcome_files.hpp"
#include "specimens/case/case_file.hpp"
#include "tests/specimens/calibration/known_rock.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using RecoveredRock = testing::KnownRock;
using testing::agrees;
using testing::true_cohesion;
using testing::true_modulus;
using testing::true_ratio;
using testing::true_tensile;

TEST_F(RecoveredRock, HasItsKeysWithinTheStatedIntervals) {
    const Rock rock = rock_of(measured_targets(16) + testing::elastic_keys + testing::strength_keys, 8, 24, 12);
    const CalibrationOutcome outcome = calibrated(rock);
    fmt::print("{}", calibration_text(rock, outcome));
    // Fresh, fitted and measured packings each know a mean to their standard error.
    for (std::size_t k = 0; k < rock.targets.size(); ++k) {
        const ReachedTarget& t = outcome.targets[k];
        const double error = std::hypot(t.fresh.standard_error / t.fresh.mean, t.polish.standard_error / t.polish.mean,
                                        rock.targets[k].error);
        EXPECT_LE(std::abs(t.deviation), 3.0 * error) << rock.targets[k].name(rock.tests);
    }
    const std::vector<double> truth{true_modulus, true_ratio, true_tensile, true_cohesion};
    for (std::size_t k = 0; k < truth.size(); ++k) {
        EXPECT_TRUE(outcome.keys[k].determined) << rock.free[k].name();
        EXPECT_LE(outcome.keys[k].low, truth[k]) << rock.free[k].name();
        EXPECT_GE(outcome.keys[k].high, truth[k]) << rock.free[k].name();
    }
    // The cases that it leaves are read back as what it found.
    write_calibration(rock, outcome, folder_ / "out");
    const TestCase back = read_case(folder_ / "out" / "tension.toml");
    EXPECT_TRUE(agrees("tensile strength of the case", *back.material.tensile_strength, outcome.keys[2].value, 1e-12));
    const auto json = nlohmann::json::parse(read_file(folder_ / "out" / "calibration.json"));
    EXPECT_EQ(json["targets"].size(), 4U);
    EXPECT_EQ(json["keys"][2]["value"].get<double>(), outcome.keys[2].value);
}

}  // namespace
}  // namespace crackle
