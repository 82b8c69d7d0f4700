// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of a rock give at points of its free keys, run as a campaign: each once, whoever asks again.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "specimens/calibration/rock.hpp"
#include "specimens/campaign/campaign.hpp"

namespace crackle {

/// Packings by their place: 0 is the one of the rock's first seed.
struct PackingRange {
    std::int64_t first = 0, count = 0;
};

class Measurements {
  public:
    /// @param keep of its tests  @param options of its campaign
    Measurements(const Rock& rock, Keep keep, CampaignOptions options, CampaignHooks hooks);

    /// Runs what is not there yet. @param values of all free keys, a vector a point
    /// @throws InputError if a figure is none of the test's; TestInterrupted
    void measure(const std::vector<std::vector<double>>& points, PackingRange packings);

    /// Targets' figures, a row a packing and a column a target; not a number where a test has gone wrong, or has not
    /// failed and the figure belongs to the peak.
    Eigen::MatrixXd figures(const std::vector<double>& point, PackingRange packings) const;

    std::int64_t tests() const { return tests_; }  ///< that there are
    double processor_seconds() const { return processor_seconds_; }
    const CampaignOptions& options() const { return options_; }

  private:
    void read(const Plan& plan);

    const Rock& rock_;
    Keep keep_;
    CampaignOptions options_;
    CampaignHooks hooks_;
    std::vector<std::vector<double>> points_;
    std::map<std::pair<std::size_t, std::int64_t>, std::vector<double>> known_;  // (point, packing) to figures
    std::int64_t tests_ = 0;
    double processor_seconds_ = 0.0;
};

}  // namespace crackle
