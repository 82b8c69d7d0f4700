// SPDX-License-Identifier: GPL-3.0-or-later
// A rock of circles whose keys are known, and its simulated laboratory results.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "specimens/calibration/calibrate.hpp"
#include "specimens/calibration/linear_figures.hpp"
#include "specimens/calibration/measurements.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_circles_rock.hpp"

namespace crackle::testing {

inline constexpr double true_modulus = 20e9, true_ratio = 2.5, true_tensile = 10e6, true_cohesion = 2.0;

/// Base class for tests of calibrations; the rock is in compression.toml and tension.toml.
class KnownRock : public ::testing::Test {
  protected:
    KnownRock() { write_circles_rock(folder_, true_modulus, true_ratio, true_tensile, true_cohesion); }

    Rock rock_of(const std::string& text, int fit = 4, int polish = 4, int fresh = 4) const {
        write_text(folder_ / "rock.toml",
                   fmt::format("title = \"Circles\"\n{}{}[packings]\nfit = {}\npolish = {}\nfresh = {}\n",
                               circles_tests, text, fit, polish, fresh));
        return read_rock(folder_ / "rock.toml");
    }
    CalibrationOutcome calibrated(const Rock& rock, const char* folder = "out") const {
        return calibrate(rock, {.folder = folder_ / folder, .workers = 2});
    }
    /// Linear results of a rock's fitted packings for given keys.
    std::vector<double> linear(const Rock& rock, const std::vector<double>& values,
                               const char* packings = "packings") const {
        LinearRequest request;
        request.rock = &rock;
        request.tests = {0};
        request.packings = folder_ / packings;
        request.workers = 2;
        return mean_linear_figures(request, values)[0];
    }
    /// Targets with means and standard errors as found by a laboratory, on packings of their own.
    std::string measured_targets(int packings) const {
        const std::vector<std::pair<const char*, const char*>> figures{{"compression", "youngs_modulus"},
                                                                       {"compression", "poissons_ratio"},
                                                                       {"compression", "peak_stress"},
                                                                       {"tension", "peak_stress"}};
        std::string text;
        for (const auto& [test, figure] : figures) text += target_text(test, figure, 1.0);
        Rock rock = rock_of(text + elastic_keys + strength_keys);
        rock.first_seed = 5001;
        Measurements laboratory(rock, Keep::figures, {.folder = folder_ / "laboratory", .workers = 2}, {});
        const std::vector<double> truth{true_modulus, true_ratio, true_tensile, true_cohesion};
        laboratory.measure({truth}, {0, packings});
        const Eigen::MatrixXd all = laboratory.figures(truth, {0, packings});
        text.clear();
        for (std::size_t k = 0; k < figures.size(); ++k) {
            const Eigen::VectorXd column = all.col(static_cast<Eigen::Index>(k));
            const double mean = column.mean(), n = static_cast<double>(packings);
            const double error = std::sqrt((column.array() - mean).square().sum() / (n - 1.0) / n);
            text += target_text(figures[k].first, figures[k].second, mean, fmt::format("error = {:.6g}", error / mean));
        }
        return text;
    }

    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";
};

}  // namespace crackle::testing
