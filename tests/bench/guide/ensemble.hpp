// SPDX-License-Identifier: GPL-3.0-or-later
// The guide's rock on many packings: which tests there are, what each measures, and running them with a cache.
//
// An elastic test is prepared and solved, not loaded: counts, back-tensions, modulus, time step, and the processor time
// of a simulated second. A tension or compression test is loaded until it fails: strength and moduli of its curve.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "specimens/case/test_case.hpp"
#include "tests/bench/guide/experiments.hpp"

namespace crackle::studies {

inline constexpr const char* elastic_test = "elastic";

struct GuideTest {
    std::string experiment = as_shipped;
    std::string law;       ///< numerics.contact_law
    std::string specimen;  ///< circles, delaunay, voronoi
    std::string loading;   ///< elastic, tension, compression
    std::int64_t seed = 1;

    auto operator<=>(const GuideTest&) const = default;
    std::string name() const;  ///< of its file in the cache
};

/// Circles are tested under this alone: laws differ only where one touches the very end of a platen's face, which moves
/// the modulus by 0.02 %.
inline constexpr const char* law_of_circles = "rounded";
GuideTest guide_test(const std::string& experiment, const std::string& law, const std::string& specimen,
                     const std::string& loading, std::int64_t seed);

struct GuideResult {
    std::map<std::string, double> quantities;  ///< units: unit_of_quantity()
    std::string error;                         ///< why there are none
};
using GuideResults = std::map<GuideTest, GuideResult>;

std::string unit_of_quantity(const std::string& quantity);

struct EnsembleOptions {
    std::filesystem::path cases = "specimens/guide_rock";  ///< folder of the shipped cases
    std::filesystem::path cache;                           ///< folder, made if absent
    double rate_factor = 1.0;                              ///< times as fast as shipped
    int jobs = 1;                                          ///< tests at a time, each on one thread
};

/// The shipped case of a test with the experiment's changes. @throws InputError
TestCase guide_case(const GuideTest& test, const EnsembleOptions& options);

/// One test, from its case. What makes a specimen impossible (such as a cell that the inset destroys) is its result's
/// error. @throws TestInterrupted
GuideResult measure_guide_test(const TestCase& description, const GuideTest& test,
                               const std::function<bool()>& interrupted);

struct EnsembleHooks {
    std::function<void(std::size_t done, std::size_t all, const GuideTest& last)> progress;
    std::function<bool()> interrupted;
};

/// Runs the tests in their order, those in the cache excepted; an interrupted test leaves nothing. A cached result
/// counts only for the very case it was made from. @return whatever is known at the end, by test
GuideResults run_guide_tests(const std::vector<GuideTest>& tests, const EnsembleOptions& options,
                             const EnsembleHooks& hooks);

}  // namespace crackle::studies
