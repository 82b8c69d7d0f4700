// SPDX-License-Identifier: GPL-3.0-or-later
// A rock to be calibrated: its tests, what a laboratory has measured of it, and which keys of its cases are free.
//
//   title = "…"
//   [[test]]     name, case, set                              as in a campaign's plan
//   [[target]]   test, figure, value, tolerance, error        a figure of summary.json that the mean is to reach
//                over                                         or its ratio to another one of the same test
//                tests, figure                                or what a law fitted to several compressions has
//   [[free]]     key, of, from, to, start                     a key to be found between bounds; with `of` its ratio to
//   another
//   [[curve]]    test, file                                   measured, drawn beside the fresh packings' curves
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

struct Target {
    std::size_t test = 0;  ///< into Rock::tests
    /// Of a law of strength over confinement: these tests, `test` the first of them; else empty.
    std::vector<std::size_t> tests = {};
    std::string figure;       ///< of summary.json, "peak_stress"; or of the law, friction_angle, hoek_brown_m
    std::string over = {};    ///< of summary.json, too: the target is the ratio to it; empty: the figure
    double value = 0.0;       ///< > 0, in the units of the figure
    double tolerance = 0.05;  ///< share of the value that the mean may be off by
    double error = 0.0;       ///< standard error of the value itself, as a share of it
    std::string where;

    bool of_law() const { return !tests.empty(); }
    std::string quantity() const { return over.empty() ? figure : figure + " over " + over; }
    std::string source(const std::vector<PlannedTest>& all) const;  ///< names of its tests
    std::string name(const std::vector<PlannedTest>& all) const { return source(all) + " " + quantity(); }
    std::string unit(bool area_units) const;  ///< empty of a number without one
};

/// A number to be found. Searched on a logarithmic scale where its bounds are above 0, else on a linear one.
struct FreeKey {
    std::string key;
    std::string of = {};  ///< another free key: what is found is the ratio to it; empty: the value
    double from = 0.0, to = 0.0, start = 0.0;
    std::string where = {};

    bool logarithmic() const { return from > 0.0; }
    double scale() const { return to - from; }  ///< of a linear one
    double to_variable(double value) const;
    double to_value(double variable) const;
    std::string name() const { return of.empty() ? key : key + " over " + of; }
};

struct MeasuredCurve {
    std::size_t test = 0;
    std::filesystem::path file;
    std::vector<std::pair<double, double>> points;  ///< strain, stress
};

struct Rock {
    std::filesystem::path file;
    std::string text, title;
    std::vector<PlannedTest> tests;
    std::vector<Target> targets;
    std::vector<FreeKey> free;
    std::vector<MeasuredCurve> curves;
    std::int64_t fit = 8;      ///< packings that every point of a design is run on
    std::int64_t polish = 40;  ///< that the last correction is made on
    std::int64_t fresh = 20;   ///< others, that the result is judged by
    std::int64_t first_seed = 1;
    double time_limit = 0.0;  ///< s of the wall clock a test; 0: none

    /// Keys and values of cases. @param values of the free keys in their order, ratios where they have `of`
    std::vector<CaseSetting> settings(std::span<const double> values) const;
    TestCase case_of(std::size_t test, std::span<const double> values) const;
};

/// @throws InputError «file:line: key: found X, expected Y», also where a corner of the bounds gives an impossible case
Rock read_rock(const std::filesystem::path& path);

/// Table of the keys of a rock's file, for people.
std::string describe_rock_keys();

}  // namespace crackle
