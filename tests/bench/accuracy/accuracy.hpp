// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision studies: processor time needed for a given error, for each contact law and integrator.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle::accuracy {

/// One run, or the mean of several runs that differ only in their initial state.
struct AccuracyRow {
    std::string study;       ///< snake_case; each study is one panel of the picture
    std::string law;         ///< contact law of polygons; all laws are the same for circles, which are listed as
                             ///< rounded
    std::string integrator;  ///< leapfrog or consistent
    std::string parameter;   ///< varied parameter: time_step (relative to the stable step), axial_strain_rate (1/s) or
                             ///< rate_tolerance
    double value = 0.0;
    double cpu_seconds = 0.0;  ///< processor time, median_cpu_seconds()
    double error = 0.0;        ///< dimensionless, as defined by the study
};

struct AccuracyStudy {
    std::string name;   ///< as in AccuracyRow
    std::string title;  ///< title of the panel
    std::string error;  ///< title of the error axis, which names the compared values
    std::function<std::vector<AccuracyRow>(bool quick)> run;
};

/// All studies, in the order of the panels.
const std::vector<AccuracyStudy>& accuracy_studies();

/// Median processor time of three calls, s. Work that takes over half a second is called only once.
double median_cpu_seconds(const std::function<void()>& work);

// The studies that each source file defines.
std::vector<AccuracyStudy> collision_studies();
std::vector<AccuracyStudy> specimen_studies();

}  // namespace crackle::accuracy
