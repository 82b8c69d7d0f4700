// SPDX-License-Identifier: GPL-3.0-or-later
// A rock from its laboratory values: free keys of its cases are moved until the means of figures over packings are the
// targets.
//
// The structure first, statistics for the rest. Elastic keys (contact_modulus, stiffness_ratio, …) are found from
// moduli by sparse linear solves, without loading anything; what tests measure beside the linear solution is a factor,
// learnt on the way. The others come from a response surface (surface.hpp) of the figures' logarithms over a wide
// design around the last solution, on the same packings and the same random factors at every point; where
// tensile_strength and cohesion (as its ratio) are free, strengths are known to go with the first power of
// tensile_strength. The last correction is made on many packings; what is reported is measured on fresh ones.
//
// All tests go through a campaign's ledger: stopped at any moment the same call goes on, and one with other targets
// reuses what was run.
//
//   DIR/search/   campaign of the search    DIR/fresh/   campaign of the fresh packings, with curves
// Tested by tests/specimens/calibration/calibrate_test.cpp and recovered_rock_test.cpp; ten rocks:
// tests/benchmarks/calibrations.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "specimens/calibration/judgement.hpp"
#include "specimens/calibration/rock.hpp"
#include "specimens/calibration/surface_quality.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/statistics/mean.hpp"

namespace crackle {

struct CalibrationOptions {
    std::filesystem::path folder;
    int workers = 1;
    bool endless = false;  ///< as TestOptions::endless
};

struct CalibrationHooks {
    std::function<void(const std::string&)> stage;  ///< what is being done, a line each
    std::function<void(const std::string& stage, const CampaignProgress&)> progress;
    std::function<void(const std::string&)> told;
    std::function<bool()> interrupted;
};

struct FoundKey {
    double value = 0.0;
    /// 95 % interval, from the scatter of the figures over packings and the targets' own errors; the bounds where the
    /// targets do not determine it.
    double low = 0.0, high = 0.0;
    bool determined = true;
    /// Not determined, for the scatter of the packings alone: the interval fills the bounds.
    bool lost_in_scatter = false;
    bool at_bound = false;
};

/// One compromise between targets that cannot be reached together, measured on the fit packings.
struct FrontierPoint {
    double weight = 1.0;  ///< of the target that is missed by most, over the others'
    std::vector<double> values;
    std::vector<MeanFigure> figures;
};

/// A combination of keys along which no target changes by half its tolerance.
struct FreeDirection {
    std::vector<double> factors;  ///< of each key, along a step whose largest is 1.35 (of a linear key: a difference,
                                  ///< of 0.3 of its range)
    double change = 0.0;          ///< of the targets, in tolerances
};

struct CalibrationOutcome {
    std::vector<FoundKey> keys;
    std::vector<ReachedTarget> targets;
    std::size_t frontier_of = 0;          ///< into targets: the one that the frontier is about
    std::vector<FrontierPoint> frontier;  ///< empty: none was drawn
    std::vector<SurfaceQuality> surfaces;
    std::vector<FreeDirection> undetermined;
    std::vector<std::vector<double>> tried;        ///< values of the free keys, every point of the search
    std::vector<std::vector<double>> tried_means;  ///< and the targets' means there, fit packings
    int rounds = 0;
    std::int64_t tests = 0, linear_solves = 0;
    double processor_seconds = 0.0;  ///< of all tests, also those of earlier calls

    bool all_reached() const;
    std::vector<double> values() const;
};

/// @throws InputError, OutputError; TestInterrupted: the same call goes on
CalibrationOutcome calibrate(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks = {});

}  // namespace crackle
