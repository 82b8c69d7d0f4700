// SPDX-License-Identifier: GPL-3.0-or-later
// A rock to be calibrated: its tests, the values measured in a laboratory, and the free keys of its cases.
//
//   title = "…"
//   [[test]]     name, case, set                              as in a campaign's plan
//   [[target]]   test, figure, value, tolerance, error        a figure of summary.json whose mean should reach `value`,
//                over                                         or its ratio to another figure of the same test,
//                tests, figure                                or a constant of a law fitted to several compressions
//   [[free]]     key, of, from, to, start                     a key to be calibrated within bounds; with `of`, its
//                                                             ratio to another key
//   [[curve]]    test, file                                   a measured curve, plotted with those of fresh packings
//   [packings]   fit, polish, fresh, first_seed
//   [run]        time_limit
//
// Tested by tests/specimens/calibration/rock_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "specimens/campaign/plan.hpp"

namespace crackle {

/// A result that the calibrated rock should reproduce.
struct Target {
    std::size_t test = 0;  ///< index into Rock::tests
    /// Tests under different confining pressures; a law is fitted to their strengths. The first one is `test`. Empty if
    /// the target is a result of a single test.
    std::vector<std::size_t> tests = {};
    std::string figure;  ///< name in summary.json, or a constant of the law: "friction_angle", "hoek_brown_m"
    /// Name in summary.json of the result to divide by; if empty, `figure` itself is the target.
    std::string over = {};
    double value = 0.0;       ///< > 0, in the unit of the result
    double tolerance = 0.05;  ///< allowed deviation of the mean, relative to the value
    double error = 0.0;       ///< standard error of the laboratory value, relative to that value
    std::string where;

    /// Whether the figure is a constant of a law fitted to several tests.
    bool of_law() const { return !tests.empty(); }
    /// Name of the figure, or of the ratio between two figures.
    std::string quantity() const { return over.empty() ? figure : figure + " over " + over; }
    std::string source(const std::vector<PlannedTest>& all) const;  ///< names of the target's tests
    /// Name of the target: its tests and its figure. @param all  tests of the rock
    std::string name(const std::vector<PlannedTest>& all) const { return source(all) + " " + quantity(); }
    std::string unit(bool area_units) const;  ///< empty if the target has no unit
};

/// A key to be found. The search uses a logarithmic scale if the lower bound is positive, otherwise a linear one.
struct FreeKey {
    std::string key;
    /// Another free key: the ratio to its value is calibrated. If empty, the key's own value is calibrated.
    std::string of = {};
    double from = 0.0, to = 0.0, start = 0.0;
    bool start_given = true;  ///< if false, `start` is the middle of the bounds, and starting_values() may replace it
    std::string where = {};

    /// Whether the key is searched on a logarithmic scale.
    bool logarithmic() const { return from > 0.0; }
    double scale() const { return to - from; }  ///< range between the bounds, for a key on a linear scale
    /// Search variable for a value of the key: its logarithm on a logarithmic scale, otherwise its share of the range.
    double to_variable(double value) const;
    /// Value of the key, in its unit, for a search variable.
    double to_value(double variable) const;
    /// Name of the key, or of the ratio of two keys.
    std::string name() const { return of.empty() ? key : key + " over " + of; }
};

/// A stress-strain curve from the laboratory, plotted with those of the tests.
struct MeasuredCurve {
    std::size_t test = 0;
    std::filesystem::path file;
    std::vector<std::pair<double, double>> points;  ///< strain, stress
};

/// Contents of a rock file: tests, targets and free keys.
struct Rock {
    std::filesystem::path file;
    std::string text, title;
    std::vector<PlannedTest> tests;
    std::vector<Target> targets;
    std::vector<FreeKey> free;
    std::vector<MeasuredCurve> curves;
    std::int64_t fit = 8;      ///< number of packings tested at each point of a design
    std::int64_t polish = 40;  ///< number of packings used for the last correction
    std::int64_t fresh = 20;   ///< number of fresh packings on which the result is judged
    std::int64_t first_seed = 1;
    double time_limit = 0.0;  ///< s of wall-clock time per test; 0: no limit

    /// Keys and values to set in the cases. @param values  values of the free keys in order; ratios for keys with `of`
    std::vector<CaseSetting> settings(std::span<const double> values) const;
    /// The case of a test with given values of the free keys.
    /// @param test  index into `tests`
    /// @param values  values of the free keys in order
    ResolvedCase case_of(std::size_t test, std::span<const double> values) const;
};

/// @throws InputError «file:line: key: found X, expected Y», also if a combination of the bounds gives an impossible
/// case
Rock read_rock(const std::filesystem::path& path);

/// Formats the keys of a rock file as a table for users.
std::string describe_rock_keys();

}  // namespace crackle
