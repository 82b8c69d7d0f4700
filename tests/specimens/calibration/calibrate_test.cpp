// SPDX-License-Identifier: GPL-3.0-or-later
// Tests calibrations of rocks whose keys are known. recovered_rock_test.cpp recovers all keys of a rock,
// tests/benchmarks/calibrations those of ten rocks.

#include "specimens/calibration/calibrate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "solver/base/errors.hpp"
#include "specimens/calibration/measurements.hpp"
#include "specimens/calibration/outcome_files.hpp"
#include "specimens/envelope/strength_envelope.hpp"
#include "specimens/making/hooks.hpp"
#include "tests/specimens/calibration/known_rock.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::target_text;

using CalibrationTest = testing::KnownRock;
using testing::true_cohesion;
using testing::true_modulus;
using testing::true_ratio;
using testing::true_tensile;

TEST_F(CalibrationTest, ElasticKeysComeFromTheLinearSolveOfTheSamePackings) {
    const std::vector<double> truth{true_modulus, true_ratio};
    const Rock any = rock_of(target_text("compression", "youngs_modulus", 1.0) + testing::elastic_keys);
    const std::vector<double> moduli = linear(any, truth);
    const Rock rock =
        rock_of(target_text("compression", "youngs_modulus", moduli[0], "tolerance = 0.01") +
                target_text("compression", "poissons_ratio", moduli[1], "tolerance = 0.01") + testing::elastic_keys);
    const CalibrationOutcome outcome = calibrated(rock);
    // Moduli measured in tests differ from linear ones because of the loading rate, by at most 1e-3 here. Poisson's
    // ratio changes half as much as the stiffness ratio.
    EXPECT_TRUE(agrees("contact modulus", outcome.keys[0].value, true_modulus, 5e-3));
    EXPECT_TRUE(agrees("stiffness ratio", outcome.keys[1].value, true_ratio, 1e-2));
    EXPECT_TRUE(outcome.undetermined.empty());
    EXPECT_TRUE(outcome.frontier.empty());
    EXPECT_EQ(outcome.tests, 2 * 2 * 4) << "both tests, one point with fit packings and with fresh ones: "
                                        << calibration_text(rock, outcome);
    const LedgerTable seeds = CampaignLedger::read(folder_ / "out" / "fresh" / "campaign.sqlite")
                                  .query("SELECT min(seed), max(seed) FROM plan");
    EXPECT_EQ(std::get<double>(seeds.rows[0][0]), 5.0) << "fresh packings differ from those of the fit";
    EXPECT_EQ(std::get<double>(seeds.rows[0][1]), 8.0);
}

TEST_F(CalibrationTest, ALinearSolveNamesAFolderWhoseNameIsNotUtf8) {
    testing::write_text(folder_ / "\xff", "no folder");
    const Rock any = rock_of(target_text("compression", "youngs_modulus", 1.0) + testing::elastic_keys);
    try {
        linear(any, {true_modulus, true_ratio}, "\xff");
        ADD_FAILURE() << "packings were written to a path that is a file";
    } catch (const OutputError& error) {
        EXPECT_NE(std::string_view(error.what()).find((folder_ / "\xff").string()), std::string_view::npos)
            << error.what();
    }
}

TEST_F(CalibrationTest, AllStressesAndModuliTimesALambdaAreTheSameTests) {
    constexpr double lambda = 4.0;  // a power of two, so that speeds are multiplied by exactly sqrt(λ)
    const Rock rock =
        rock_of(target_text("compression", "peak_stress", 1e7) + target_text("tension", "peak_stress", 1e6) +
                testing::elastic_keys + testing::strength_keys);
    Measurements tests(rock, Keep::figures, {.folder = folder_ / "out", .workers = 2}, {});
    const std::vector<double> here{true_modulus, true_ratio, true_tensile, true_cohesion};
    const std::vector<double> there{lambda * true_modulus, true_ratio, lambda * true_tensile, true_cohesion};
    tests.measure({here, there}, {0, 4});
    const Eigen::MatrixXd a = tests.figures(here, {0, 4}), b = tests.figures(there, {0, 4});
    for (Eigen::Index k = 0; k < a.rows(); ++k)
        for (Eigen::Index t = 0; t < a.cols(); ++t)
            EXPECT_TRUE(agrees("strength over lambda", b(k, t) / lambda, a(k, t), 1e-6)) << k << ' ' << t;
}

TEST_F(CalibrationTest, RatiosAndLawsAreThoseOfEachPackingsTests) {
    const Rock rock = rock_of(testing::pressed_tests + target_text("compression", "peak_stress", 1e7) +
                              target_text("pressed", "peak_stress", 1e7) + target_text("squeezed", "peak_stress", 1e7) +
                              target_text("compression", "crack_damage_stress", 1e7) +
                              target_text("compression", "crack_damage_stress", 0.8, "over = \"peak_stress\"") +
                              testing::law_target_text("friction_angle", 40) +
                              testing::law_target_text("hoek_brown_m", 15) + testing::strength_keys);
    Measurements tests(rock, Keep::figures, {.folder = folder_ / "out", .workers = 2}, {});
    const std::vector<double> here{true_tensile, true_cohesion};
    tests.measure({here}, {0, 4});
    const Eigen::MatrixXd all = tests.figures(here, {0, 4});
    for (Eigen::Index k = 0; k < all.rows(); ++k) {
        EXPECT_TRUE(agrees("a ratio", all(k, 4), all(k, 3) / all(k, 0), 1e-15));
        const FittedLaws laws =
            fit_laws(std::vector<StrengthPoint>{{"", 0.0, all(k, 0)}, {"", 1e6, all(k, 1)}, {"", 3e6, all(k, 2)}});
        EXPECT_TRUE(agrees("friction angle", all(k, 5), laws.friction_angle, 1e-12));
        EXPECT_TRUE(agrees("m", all(k, 6), laws.hoek_brown_m, 1e-9));
        EXPECT_GT(all(k, 1), all(k, 0)) << "a pressure makes it stronger";
    }
}

/// Four packings whose results are changed in the ledger: the second has no strength under 3 MPa, and the third did not
/// fail in compression.
TEST_F(CalibrationTest, APackingThatLacksAStrengthHasNeitherLawNorModulusAtHalfThePeak) {
    const Rock rock = rock_of(
        std::string(testing::pressed_tests) +
        "[[test]]\nname = \"between\"\ncase = \"compression.toml\"\n"
        "set = {\"loading.kind\" = \"biaxial\", \"confinement.pressure\" = 2e6}\n" +
        target_text("compression", "tangent_modulus_50", 1e10) + target_text("compression", "largest_stress", 1e7) +
        testing::law_target_text("friction_angle", 40, "[\"compression\", \"pressed\", \"between\", \"squeezed\"]") +
        testing::strength_keys);
    const CampaignOptions options{.folder = folder_ / "out", .workers = 2};
    const std::vector<double> here{true_tensile, true_cohesion};
    std::vector<std::int64_t> without_peak;  // of each target
    const auto measured = [&] {
        Measurements tests(rock, Keep::figures, options, {});
        tests.measure({here}, {0, 4});
        without_peak.clear();
        for (std::size_t t = 0; t < 3; ++t) without_peak.push_back(tests.without_peak(here, {0, 4}, t));
        return tests.figures(here, {0, 4});
    };
    const Eigen::MatrixXd before = measured();
    EXPECT_EQ(without_peak, (std::vector<std::int64_t>{0, 0, 0}));
    ASSERT_TRUE(before.array().isFinite().all());
    {
        CampaignLedger ledger = CampaignLedger::open(ledger_file(options.folder));
        const auto unfailed = [&](std::int64_t packing, const char* test) {
            const LedgerTable row = ledger.query(
                fmt::format("SELECT * FROM results WHERE test = '{}' AND seed = {}", test, rock.first_seed + packing));
            RowResult result;
            result.state = row_done;
            for (std::size_t k = 0; k < row.columns.size(); ++k) {
                const std::string& name = row.columns[k];
                const auto* number = std::get_if<double>(&row.rows[0][k]);
                if (name == "identity") result.identity = std::get<std::string>(row.rows[0][k]);
                for (const char* kept : {"tangent_modulus_50", "largest_stress", "confining_pressure"})
                    if (name == kept && number != nullptr) result.figures.emplace_back(name, *number);
            }
            result.figures.emplace_back("failed", 0.0);
            ledger.record(result, "here");
        };
        unfailed(1, "squeezed");
        unfailed(2, "compression");
    }
    const Eigen::MatrixXd after = measured();
    EXPECT_EQ(without_peak, (std::vector<std::int64_t>{1, 0, 2})) << "the law lacks two packings";
    for (Eigen::Index k = 0; k < 4; ++k) {
        EXPECT_EQ(std::isnan(after(k, 0)), k == 2) << "no window at half the peak: " << k;
        EXPECT_EQ(after(k, 1), before(k, 1)) << "the largest stress does not require failure: " << k;
        EXPECT_EQ(std::isnan(after(k, 2)), k == 1 || k == 2)
            << "a fit to three strengths would be a different law: " << k;
        if (k == 0 || k == 3) {
            EXPECT_EQ(after(k, 2), before(k, 2)) << k;
        }
    }
}

/// Variances of independent errors add up. Doubling the laboratory's error therefore adds four times as much to the
/// square of the interval's half width, whatever the scatter of the packings and the slope.
TEST_F(CalibrationTest, TheLaboratorysErrorWidensTheIntervalAsItsSquare) {
    const Rock any = rock_of(target_text("compression", "poissons_ratio", 1.0) + testing::elastic_keys);
    const double aim = linear(any, {true_modulus, 2.5})[1];
    std::array<double, 3> squares{};
    for (std::size_t k = 0; k < squares.size(); ++k) {
        const Rock rock =
            rock_of(target_text("compression", "poissons_ratio", aim,
                                fmt::format("tolerance = 0.01\nerror = {}", 0.01 * static_cast<double>(k))) +
                    "[[free]]\nkey = \"material.stiffness_ratio\"\nfrom = 1\nto = 10\nstart = 2.5\n");
        const FoundKey key = calibrated(rock).keys[0];
        ASSERT_TRUE(key.determined);
        squares.at(k) = std::pow(0.5 * std::log(key.high / key.low), 2.0);
    }
    EXPECT_TRUE(agrees("of twice the error over that of once", (squares[2] - squares[0]) / (squares[1] - squares[0]),
                       4.0, 1e-6));
}

TEST_F(CalibrationTest, ANarrowRangeIsSearchedToItsRightEnd) {
    const Rock any = rock_of(target_text("compression", "poissons_ratio", 1.0) + testing::elastic_keys);
    const double aim = linear(any, {true_modulus, 2.68})[1];
    // Bounds narrower than the first step of the search, which starts at the wrong end.
    const Rock rock = rock_of(target_text("compression", "poissons_ratio", aim, "tolerance = 0.002") +
                              "[[free]]\nkey = \"material.stiffness_ratio\"\nfrom = 2.60\nto = 2.70\nstart = 2.60\n");
    EXPECT_TRUE(agrees("stiffness ratio", calibrated(rock).keys[0].value, 2.68, 3e-3));
}

TEST_F(CalibrationTest, WhatTargetsDoNotDetermineIsNamed) {
    const Rock rock = rock_of(target_text("tension", "peak_stress", 6e6) + testing::strength_keys);
    const CalibrationOutcome outcome = calibrated(rock);
    const std::string text = calibration_text(rock, outcome);
    fmt::print("{}", text);
    ASSERT_EQ(outcome.undetermined.size(), 1U) << "a tensile strength does not determine the cohesion";
    EXPECT_FALSE(outcome.keys[1].determined);
    EXPECT_EQ(outcome.keys[1].high, 6.0) << "its interval equals its bounds";
    EXPECT_NE(text.find("not determined by the targets: "), std::string::npos);
}

TEST_F(CalibrationTest, TestsThatNeverFailAreToldOf) {
    Rock rock = rock_of(target_text("compression", "peak_stress", 3e7) + testing::strength_keys);
    for (PlannedTest& test : rock.tests) test.settings.push_back({"loading.max_axial_strain", 1e-5, "here:1"});
    try {
        calibrated(rock);
        ADD_FAILURE() << "it found something";
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_NE(std::string(error.what()).find("max_axial_strain"), std::string::npos);
    }
}

}  // namespace
}  // namespace crackle
