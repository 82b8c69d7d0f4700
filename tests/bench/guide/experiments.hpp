// SPDX-License-Identifier: GPL-3.0-or-later
// Settings that the guide does not state, so that its tests may have used other values. Each experiment changes one
// setting of the shipped cases.
// Tested by tests/bench_tests/guide/ensemble_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/case/case_file.hpp"

namespace crackle::studies {

inline constexpr const char* as_shipped = "shipped";  ///< the experiment that changes nothing

/// Tests that an experiment changes; for all others the shipped test is used.
struct Reach {
    bool circles = true, polygons = true;
    bool elastic = true, tension = true, compression = true;

    bool holds(const std::string& specimen, const std::string& loading) const;
};

struct GuideExperiment {
    std::string name;
    std::string sentence;
    Reach reach;
    std::vector<CaseSetting> (*settings)(const ResolvedCase& shipped);
    double rate = 1.0;             ///< factor on the loading rate
    bool without_platens = false;  ///< specimen without platens; its tests measure only counts and back-tensions
};

/// All experiments, beginning with the shipped case.
const std::vector<GuideExperiment>& guide_experiments();
const GuideExperiment& guide_experiment(const std::string& name);

}  // namespace crackle::studies
