// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the guide's rock on many packings: the list of tests, the quantities that each measures, and running them
// with a cache.
//
// An elastic test is prepared and solved, but not loaded. It measures counts, back-tensions, modulus, time step, and
// the processor time per simulated second. A tension or compression test is loaded until it fails; it measures strength
// and the moduli of its curve.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "specimens/parts/resolved_case.hpp"
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
    std::string name() const;  ///< name of its file in the cache
};

/// Circles are tested only with this law. The laws differ only for a circle that touches the very end of a platen's
/// face, which changes the modulus by 0.02 %.
inline constexpr const char* law_of_circles = "rounded";
GuideTest guide_test(const std::string& experiment, const std::string& law, const std::string& specimen,
                     const std::string& loading, std::int64_t seed);

struct GuideResult {
    std::map<std::string, double> quantities;  ///< units: unit_of_quantity()
    std::string error;                         ///< reason if there are no quantities
};
using GuideResults = std::map<GuideTest, GuideResult>;

std::string unit_of_quantity(const std::string& quantity);

struct EnsembleOptions {
    std::filesystem::path cases = "specimens/guide_rock";  ///< folder of the shipped cases
    std::filesystem::path cache;                           ///< folder, created if missing
    double rate_factor = 1.0;                              ///< loading rate relative to the shipped cases
    int jobs = 1;                                          ///< number of tests run at the same time, each on one thread
};

/// The shipped case of a test, with the changes made by its experiment. @throws InputError
ResolvedCase guide_case(const GuideTest& test, const EnsembleOptions& options);

/// Runs one test. If its specimen cannot be made (for example because the inset destroys a cell), the result contains
/// this error. @throws TestInterrupted
GuideResult measure_guide_test(const ResolvedCase& description, const GuideTest& test,
                               const std::function<bool()>& interrupted);

struct EnsembleHooks {
    std::function<void(std::size_t done, std::size_t all, const GuideTest& last)> progress;
    std::function<bool()> interrupted;
};

/// Runs the tests in order, except those in the cache; an interrupted test leaves no result. A cached result is used
/// only if it was made from an identical case. @return all results known at the end, by test
GuideResults run_guide_tests(const std::vector<GuideTest>& tests, const EnsembleOptions& options,
                             const EnsembleHooks& hooks);

}  // namespace crackle::studies
