// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/plotted_curves.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

namespace crackle::plot {

const Colour& colour_of(const PlottedTest& test) { return series_colour(test.colour); }

const std::vector<double>& column(const TestResults& results, const char* name) { return *results.curve.find(name); }

double largest_of(const std::vector<PlottedTest>& tests, const char* name) {
    double largest = 0.0;
    for (const PlottedTest& test : tests) {
        for (const double value : column(*test.results, name)) largest = std::max(largest, value);
    }
    return largest;
}

double smallest_of(const std::vector<PlottedTest>& tests, const char* name) {
    double smallest = 0.0;
    for (const PlottedTest& test : tests) {
        for (const double value : column(*test.results, name)) smallest = std::min(smallest, value);
    }
    return smallest;
}

std::vector<Point> curve_points(const Axes& axes, const std::vector<double>& x, double x_unit,
                                const std::vector<double>& y, double y_unit) {
    constexpr double unseen = 0.01;
    std::vector<Point> points;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const Point point = axes.at(x[k] / x_unit, y[k] / y_unit);
        if (!points.empty() && k + 1 < x.size() &&
            std::hypot(point.x - points.back().x, point.y - points.back().y) < unseen)
            continue;
        points.push_back(point);
    }
    return points;
}

CurveNames names_of_kind(const std::optional<LoadingKind>& kind) {
    return test_kind(kind.value_or(LoadingKind::compression)).curve;
}

CurveNames names_of(const std::vector<PlottedTest>& tests) {
    const auto name = [](const PlottedTest& test) { return names_of_kind(test.results->summary.about.kind); };
    constexpr CurveNames of_any_kind{"stress", "strain"};
    if (tests.empty()) return of_any_kind;
    const CurveNames first = name(tests.front());
    const bool alike = std::ranges::all_of(
        tests, [&](const PlottedTest& test) { return std::string_view(name(test).stress) == first.stress; });
    return alike ? first : of_any_kind;
}

std::vector<Legend::Entry> entries_of(const std::vector<PlottedTest>& tests) {
    std::vector<Legend::Entry> entries;
    entries.reserve(tests.size());
    for (const PlottedTest& test : tests) entries.push_back({test.label, colour_of(test), test.dashed});
    return entries;
}

Scale strain_scale(const std::vector<PlottedTest>& tests, double width, double other) {
    return scale_for(0.0, std::max(largest_of(tests, "axial_strain"), other) / strain_unit, width < 300.0 ? 6 : 10);
}

}  // namespace crackle::plot
