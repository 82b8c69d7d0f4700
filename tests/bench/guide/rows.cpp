// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/guide/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/bench/guide/experiments.hpp"

namespace crackle::studies {
namespace {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();
constexpr double deviations_allowed = 2.0;

using Test = std::pair<std::string, std::string>;

/// Row for a quantity of one test, in the given unit.
GuideRow plain(GuideRow row, const Test& test, const std::string& quantity, double unit) {
    row.tests = {test};
    row.value = [=](const Measured& m) { return m(test.first, test.second, quantity) / unit; };
    return row;
}

/// Row for the ratio of a quantity between two tests.
GuideRow ratio(GuideRow row, const Test& over, const Test& under, const std::string& quantity) {
    row.tests = {over, under};
    row.value = [=](const Measured& m) {
        return m(over.first, over.second, quantity) / m(under.first, under.second, quantity);
    };
    return row;
}

/// Row for the ratio of the processor times per step of two tests.
GuideRow step_time(GuideRow row, const Test& over, const Test& under) {
    row.tests = {over, under};
    row.value = [=](const Measured& m) {
        const auto of_step = [&](const Test& test) {
            return m(test.first, test.second, "processor_seconds_per_second") * m(test.first, test.second, "time_step");
        };
        return of_step(over) / of_step(under);
    };
    return row;
}

GuideRow judged(const char* key, const char* words, const char* guide_text, double guide, double rounding = 0.0,
                const char* unit = "-") {
    GuideRow row;
    row.key = key;
    row.words = words;
    row.guide_text = guide_text;
    row.guide = guide;
    row.rounding = rounding;
    row.unit = unit;
    return row;
}

GuideRow shown(const char* key, const char* words) { return judged(key, words, "", absent); }

std::vector<GuideRow> all_rows() {
    const Test circles{"circles", elastic_test}, circles_pulled{"circles", "tension"},
        circles_squeezed{"circles", "compression"};
    const Test delaunay{"delaunay", elastic_test}, delaunay_pulled{"delaunay", "tension"},
        delaunay_squeezed{"delaunay", "compression"};
    const Test voronoi{"voronoi", elastic_test}, voronoi_squeezed{"voronoi", "compression"};
    constexpr double kilo = 1e3;
    GuideRow voronoi_stronger =
        judged("voronoi_compressive_over_delaunay", "Voronoi compressive strength over the triangles'", "larger", 1.0);
    voronoi_stronger.at_least = true;
    return {
        plain(judged("circles_back_tension", "mean back-tension, circles, kN", "0.774", 0.774, 5e-4, "kN"), circles,
              "mean_back_tension", kilo),
        plain(judged("delaunay_back_tension", "mean back-tension, triangles, kN", "0.753", 0.753, 5e-4, "kN"), delaunay,
              "mean_back_tension", kilo),
        plain(judged("triangles", "triangles", "537", 537.0, 0.5), delaunay, "particles", 1.0),
        plain(judged("segments", "segments", "1611", 1611.0, 0.5), delaunay, "segments", 1.0),
        plain(judged("circles_stiffness", "circles' stiffness (all bonds intact) over 19.4/0.0019 kN/m", "about 1/2",
                     0.5),
              circles, "youngs_modulus", guide_limit_stiffness),
        plain(shown("circles_tangent", "the same at half the peak, pulled"), circles_pulled, "tangent_modulus_50",
              guide_limit_stiffness),
        plain(shown("circles_secant", "the same as secant at the peak, pulled"), circles_pulled, "secant_modulus",
              guide_limit_stiffness),
        plain(judged("circles_tensile_strength", "circles' tensile strength over 19.4 kN/m", "about 1/4", 0.25),
              circles_pulled, "largest_stress", guide_limit_stress),
        plain(judged("circles_compressive_strength", "circles' compressive strength over 19.4 kN/m", "about 1/2", 0.5),
              circles_squeezed, "largest_stress", guide_limit_stress),
        ratio(judged("circles_compressive_over_tensile", "circles' compressive over tensile strength", "about 2", 2.0),
              circles_squeezed, circles_pulled, "largest_stress"),
        ratio(judged("delaunay_stiffness", "triangles' stiffness (all bonds intact) over the circles'", "about √10",
                     std::sqrt(10.0)),
              delaunay, circles, "youngs_modulus"),
        ratio(shown("delaunay_tangent", "the same at half the peak, pulled"), delaunay_pulled, circles_pulled,
              "tangent_modulus_50"),
        ratio(shown("delaunay_secant", "the same as secants at the peak, pulled"), delaunay_pulled, circles_pulled,
              "secant_modulus"),
        plain(judged("delaunay_limit_strain", "triangles' tensile limit strain", "about 0.002", 0.002), delaunay_pulled,
              "strain_at_largest_stress", 1.0),
        ratio(judged("delaunay_compressive_over_tensile", "triangles' compressive over tensile strength", "about 10",
                     10.0),
              delaunay_squeezed, delaunay_pulled, "largest_stress"),
        ratio(judged("delaunay_contacts", "contacts, triangles over circles", "about 10", 10.0), delaunay, circles,
              "contacts"),
        ratio(judged("voronoi_contacts", "contacts, Voronoi polygons over triangles", "1.2", 1.2, 0.05), voronoi,
              delaunay, "contacts"),
        ratio(voronoi_stronger, voronoi_squeezed, delaunay_squeezed, "largest_stress"),
        ratio(judged("delaunay_run_time", "run time of the same simulated time, triangles over circles", "nearly 100",
                     100.0),
              delaunay, circles, "processor_seconds_per_second"),
        step_time(shown("delaunay_step_time", "the same for one time step"), delaunay, circles),
    };
}

}  // namespace

const std::vector<GuideRow>& guide_rows() {
    static const std::vector<GuideRow> all = all_rows();
    return all;
}

double row_value(const GuideRow& row, const GuideResults& results, const std::string& experiment,
                 const std::string& law, std::int64_t seed) {
    const Reach& reach = guide_experiment(experiment).reach;
    return row.value([&](const std::string& specimen, const std::string& loading, const std::string& quantity) {
        const std::string source = reach.holds(specimen, loading) ? experiment : as_shipped;
        const auto result = results.find(guide_test(source, law, specimen, loading, seed));
        if (result == results.end()) return absent;
        const auto found = result->second.quantities.find(quantity);
        return found == result->second.quantities.end() ? absent : found->second;
    });
}

Spread spread_of(const std::vector<double>& values) {
    Spread spread;
    double sum = 0.0, squares = 0.0;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        ++spread.packings;
        sum += value;
    }
    spread.mean = spread.packings > 0 ? sum / spread.packings : absent;
    for (const double value : values) {
        if (!std::isnan(value)) squares += (value - spread.mean) * (value - spread.mean);
    }
    spread.deviation = spread.packings > 1 ? std::sqrt(squares / (spread.packings - 1)) : absent;
    return spread;
}

bool reaches_guide(const GuideRow& row, double mean, const Spread& shipped) {
    if (row.at_least) return mean > row.guide;
    const double deviation = shipped.deviation * std::abs(mean / shipped.mean);
    return std::abs(row.guide - mean) <= deviations_allowed * deviation + row.rounding;
}

GuideVerdict judge(const GuideRow& row, const Spread& ours) {
    if (ours.packings < 2) return GuideVerdict::open;
    return reaches_guide(row, ours.mean, ours) ? GuideVerdict::inside : GuideVerdict::outside;
}

}  // namespace crackle::studies
