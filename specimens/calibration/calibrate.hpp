// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrates a rock to laboratory values: adjusts the free keys of its cases until the results, averaged over packings,
// reach the targets.
//
// Elastic keys (contact_modulus, stiffness_ratio, …) are found first, from moduli computed by sparse linear solves
// without loading. The ratio of each modulus measured in a test to the linear one is updated during the search. The
// other keys are found from a response surface (surface.hpp) of the logarithms of the results. It is fitted over a wide
// design around the last solution, with the same packings and random factors at every point. Strengths scale with
// tensile_strength if it is free and cohesion is calibrated as a ratio to it. The last correction uses many packings;
// the reported results are measured on new packings.
//
// All tests are run as campaigns, whose ledgers record them. After an interrupt, the same call resumes. A call with
// other targets reuses tests that have already been run.
//
//   DIR/search/   campaign of the search
//   DIR/fresh/    campaign of the fresh packings, with curves
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

/// Options of a calibration.
struct CalibrationOptions {
    std::filesystem::path folder;
    int workers = 1;
    bool retry = false;    ///< repeat tests that were refused, unstable or too slow
    bool endless = false;  ///< see TestOptions::endless
};

/// Callbacks of a calibration; empty ones are skipped.
struct CalibrationHooks {
    std::function<void(const std::string&)> stage;  ///< called with one line at the start of each stage
    std::function<void(const std::string& stage, const CampaignProgress&)> progress;
    std::function<void(const std::string&)> told;
    std::function<bool()> interrupted;
};

/// Calibrated value of a free key.
struct FoundKey {
    double value = 0.0;
    /// 95 % interval, from the scatter of results between packings and the errors of the targets; equal to the bounds
    /// if the targets do not determine the key.
    double low = 0.0, high = 0.0;
    bool determined = true;
    /// Whether the targets depend on the key, but scatter and errors are so large that its interval fills the bounds.
    bool lost_in_scatter = false;
    bool at_bound = false;
};

/// A compromise between targets that cannot be reached together, measured on the packings used for fitting.
struct FrontierPoint {
    double weight = 1.0;  ///< weight of the target with the largest deviation, relative to the others
    std::vector<double> values;
    std::vector<MeanFigure> figures;
};

/// A combination of keys along which no target changes by more than half its tolerance.
struct FreeDirection {
    /// Change of each key in one step along this direction: a factor from 0.74 to 1.35 or, for a key on a linear scale,
    /// a fraction of its range from -0.3 to 0.3.
    std::vector<double> factors;
    double change = 0.0;  ///< largest change of a target along this step, in tolerances
};

/// Result of a calibration.
struct CalibrationOutcome {
    std::vector<FoundKey> keys;
    std::vector<ReachedTarget> targets;
    /// Index into `targets` of the target that the frontier trades off against the others.
    std::size_t frontier_of = 0;
    std::vector<FrontierPoint> frontier;  ///< empty if no frontier was computed
    std::vector<SurfaceQuality> surfaces;
    std::vector<FreeDirection> undetermined;
    std::vector<std::vector<double>> tried;  ///< values of the free keys at each point of the search
    std::vector<std::vector<double>>
        tried_means;  ///< for each point in `tried`, means of the results over the packings used for fitting
    int rounds = 0;
    std::int64_t tests = 0, linear_solves = 0;
    double processor_seconds = 0.0;  ///< processor time of all tests, including those of earlier calls, s

    /// Whether every target is reached, allowing for the errors of the means.
    bool all_reached() const;
    /// Values of the free keys, in the order of Rock::free.
    std::vector<double> values() const;
};

/// @throws InputError, OutputError
/// @throws TestInterrupted if interrupted; the same call resumes
/// @throws SystemFailure if a test or a linear solve failed for a reason outside the case, such as lack of memory; the
/// same call runs it again
CalibrationOutcome calibrate(const Rock& rock, const CalibrationOptions& options, const CalibrationHooks& hooks = {});

}  // namespace crackle
