// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision studies: what an error costs in processor time, for each contact law and integrator.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle::accuracy {

/// One run, or a set of equal runs that differ in their start.
struct AccuracyRow {
    std::string study;       ///< snake_case, a panel of the picture
    std::string law;         ///< of polygons; circles are the same in all and are listed as rounded
    std::string integrator;  ///< leapfrog or consistent
    std::string parameter;  ///< what varies: time_step (over the stable one), axial_strain_rate (1/s) or rate_tolerance
    double value = 0.0;
    double cpu_seconds = 0.0;  ///< processor time, median_cpu_seconds()
    double error = 0.0;        ///< -, see the study
};

struct AccuracyStudy {
    std::string name;   ///< as in AccuracyRow
    std::string title;  ///< of the panel
    std::string error;  ///< what is compared with what, of the axis
    std::function<std::vector<AccuracyRow>(bool quick)> run;
};

/// In the order of the panels.
const std::vector<AccuracyStudy>& accuracy_studies();

/// Processor time of three calls, their median, s; of one where it takes over half a second.
double median_cpu_seconds(const std::function<void()>& work);

// The studies of each file.
std::vector<AccuracyStudy> collision_studies();
std::vector<AccuracyStudy> specimen_studies();

}  // namespace crackle::accuracy
