// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that the guide gives of its rock, how each follows from tests of one packing, and how an ensemble
// compares with it.
// Tested by tests/bench_tests/guide/ensemble_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/guide/ensemble.hpp"

namespace crackle::studies {

// The guide's limit values of its circles, which its sentences refer to: 0.774 kN over 4 cm, and overlap over diameter.
inline constexpr double guide_limit_stress = 19.4e3;                          // N/m
inline constexpr double guide_limit_stiffness = guide_limit_stress / 0.0019;  // N/m

/// A quantity of (specimen, loading) of one packing; not a number where there is none.
using Measured =
    std::function<double(const std::string& specimen, const std::string& loading, const std::string& quantity)>;

struct GuideRow {
    std::string key;
    std::string words;
    std::string guide_text;  ///< what the guide states; empty: a further figure, shown and not compared
    double guide = 0.0;
    double rounding = 0.0;  ///< half a unit of the last digit that the guide prints; 0 where it reads «about»
    bool at_least = false;  ///< the guide states «larger than»
    std::string unit;
    std::vector<std::pair<std::string, std::string>> tests;  ///< (specimen, loading) that it takes
    std::function<double(const Measured&)> value;

    bool judged() const { return !guide_text.empty(); }
};

const std::vector<GuideRow>& guide_rows();

/// The row's value of a packing; tests that the experiment does not touch are the shipped ones. Not a number where a
/// test is missing.
double row_value(const GuideRow& row, const GuideResults& results, const std::string& experiment,
                 const std::string& law, std::int64_t seed);

struct Spread {
    int packings = 0;
    double mean = 0.0;
    double deviation = 0.0;  ///< sample standard deviation; not a number for less than two packings
};
/// Values that are not numbers are left out.
Spread spread_of(const std::vector<double>& values);

enum class GuideVerdict { inside, outside, open };
/// Inside: the guide's value lies within two standard deviations (and its rounding) of our mean; where it reads
/// «larger», our mean is.
/// Open: less than two packings.
GuideVerdict judge(const GuideRow& row, const Spread& ours);
/// Whether the mean of a few packings would be inside, with the relative spread of the shipped case.
bool reaches_guide(const GuideRow& row, double mean, const Spread& shipped);

}  // namespace crackle::studies
