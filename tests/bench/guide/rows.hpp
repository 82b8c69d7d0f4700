// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that the guide states for its rock, how each is computed from tests of one packing, and how an ensemble
// is compared with it.
// Tested by tests/bench_tests/guide/ensemble_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/guide/ensemble.hpp"

namespace crackle::studies {

// The guide's limit values for its circles, to which its text refers: 0.774 kN over 4 cm, and overlap over diameter.
inline constexpr double guide_limit_stress = 19.4e3;                          // N/m
inline constexpr double guide_limit_stiffness = guide_limit_stress / 0.0019;  // N/m

/// Returns a quantity of (specimen, loading) for one packing; NaN if it was not measured.
using Measured =
    std::function<double(const std::string& specimen, const std::string& loading, const std::string& quantity)>;

struct GuideRow {
    std::string key;
    std::string words;
    std::string guide_text;  ///< the guide's statement; if empty, the value is shown but not compared
    double guide = 0.0;
    double rounding = 0.0;  ///< half a unit of the last digit printed in the guide; 0 if the guide says «about»
    bool at_least = false;  ///< the guide states «larger than»
    std::string unit;
    std::vector<std::pair<std::string, std::string>> tests;  ///< pairs (specimen, loading) that the row needs
    std::function<double(const Measured&)> value;

    bool judged() const { return !guide_text.empty(); }
};

const std::vector<GuideRow>& guide_rows();

/// The row's value for one packing. For tests that the experiment does not change, the shipped test is used. NaN if a
/// test is missing.
double row_value(const GuideRow& row, const GuideResults& results, const std::string& experiment,
                 const std::string& law, std::int64_t seed);

struct Spread {
    int packings = 0;
    double mean = 0.0;
    double deviation = 0.0;  ///< sample standard deviation; NaN for fewer than two packings
};
/// Mean and standard deviation; NaN values are ignored.
Spread spread_of(const std::vector<double>& values);

enum class GuideVerdict { inside, outside, open };
/// Inside: the guide's value is within two standard deviations (plus its rounding) of our mean. If the guide says
/// «larger», our mean must be larger. Open: there are fewer than two packings.
GuideVerdict judge(const GuideRow& row, const Spread& ours);
/// Whether the mean of a few packings would be inside, assuming the relative standard deviation of the shipped case.
bool reaches_guide(const GuideRow& row, double mean, const Spread& shipped);

}  // namespace crackle::studies
