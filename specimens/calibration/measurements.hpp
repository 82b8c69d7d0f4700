// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a rock's tests for given values of its free keys, run as a campaign. Each test is run only once.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "specimens/calibration/rock.hpp"
#include "specimens/campaign/campaign.hpp"

namespace crackle {

/// A range of packing indices; packing 0 has the rock's first seed.
struct PackingRange {
    std::int64_t first = 0, count = 0;
};

/// The tests of a calibration, as a campaign that grows with every requested point.
class Measurements {
  public:
    /// @param keep  which files of each test are kept  @param options  options of the campaign
    Measurements(const Rock& rock, Keep keep, CampaignOptions options, CampaignHooks hooks);

    /// Runs those tests that have not been run yet. @param points  values of all free keys, one vector per point
    /// @throws InputError if no test has a result for one of the targets; TestInterrupted
    /// @throws SystemFailure if tests failed for a reason outside the case: means without them would be biased
    void measure(const std::vector<std::vector<double>>& points, PackingRange packings);

    /// Results for the targets, one row per packing and one column per target. A result is NaN if its test has no
    /// result, or if it refers to the peak and the specimen has not failed.
    Eigen::MatrixXd figures(const std::vector<double>& point, PackingRange packings) const;

    /// Number of packings without a result for a target because the stress was still increasing when the test ended: a
    /// ductile specimen has no peak.
    std::int64_t without_peak(const std::vector<double>& point, PackingRange packings, std::size_t target) const;

    std::int64_t tests() const { return tests_; }  ///< number of tests in the campaign
    /// Total processor time of all tests that were run, s.
    double processor_seconds() const { return processor_seconds_; }
    /// Options of the campaign.
    const CampaignOptions& options() const { return options_; }

  private:
    void read(const Plan& plan);

    const Rock& rock_;
    Keep keep_;
    CampaignOptions options_;
    CampaignHooks hooks_;
    std::vector<std::vector<double>> points_;
    std::map<std::pair<std::size_t, std::int64_t>, std::vector<double>> known_;  // (point, packing) → figures
    /// For each point and packing, the targets whose result is missing because a test has no peak.
    std::map<std::pair<std::size_t, std::int64_t>, std::set<std::size_t>> peakless_;
    std::int64_t tests_ = 0;
    double processor_seconds_ = 0.0;
};

}  // namespace crackle
