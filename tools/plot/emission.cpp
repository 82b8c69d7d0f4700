// SPDX-License-Identifier: GPL-3.0-or-later
// Diagrams of acoustic emission: number of events against magnitude, and maps of the events' positions and times.
// Tested by tests/tools/commands/plot_test.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "specimens/emission/b_value.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

constexpr double small_letters = 0.8;  // size of small letters, relative to the font size
constexpr double magnitude_bin = 0.1;  // width of an interval of magnitude
constexpr const char* completeness_sign = "<i>M</i><span size=\"75%\" rise=\"-2pt\">c</span>";

const Colour faint = colour("#8a9199"), fitted = shear_colour;

std::string signed_number(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.starts_with('-')) text.replace(0, 1, "−");
    return text;
}

/// Finite moment magnitudes of all tests, in ascending order.
std::vector<double> pooled(const std::vector<PlottedTest>& tests) {
    std::vector<double> magnitudes;
    for (const PlottedTest& test : tests)
        for (const double m : *test.results->emission->find("moment_magnitude"))
            if (std::isfinite(m)) magnitudes.push_back(m);
    std::ranges::sort(magnitudes);
    return magnitudes;
}

/// A scale that extends slightly beyond a range. Ticks are a fraction of a magnitude, one magnitude or several
/// magnitudes apart.
Scale magnitude_scale(double low, double high, int most_ticks) {
    Scale scale;
    scale.step = 10.0;
    for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
        if ((high - low) / step > most_ticks) continue;
        scale.step = step;
        break;
    }
    const double margin = std::max(0.03 * (high - low), 0.5 * magnitude_bin);
    scale.low = low - margin;
    scale.high = high + margin;
    return scale;
}

/// A value or range as text, for example "0.2" or "0.05 to 0.2".
std::string range_text(const std::vector<PlottedTest>& tests, Number EmissionFigures::*figure, const char* unit) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PlottedTest& test : tests) {
        const auto& emission = test.results->summary.emission;
        const double value = emission ? ((*emission).*figure).or_nan() : std::nan("");
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (!(low <= high)) return "";
    const auto written = [](double value) {
        return std::abs(value) >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
    };
    const std::string from = written(low), to = written(high);
    return (from == to ? from : from + " to " + to) + unit;
}

std::string in_one_line(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, ", ")); }

/// Lines of text about the b-value; the first line is the result.
std::vector<std::string> lines_of(const BValue& value, const std::vector<PlottedTest>& tests, std::size_t all) {
    std::vector<std::string> counts, flaws, physics;
    counts.push_back(std::isnan(value.completeness)
                         ? fmt::format("{} events", all)
                         : fmt::format("{} of {} events above {} = {}", value.events, all, completeness_sign,
                                       signed_number(value.completeness, 2)));
    if (tests.size() > 1) counts.push_back(fmt::format("{} tests together", tests.size()));
    if (value.known() && value.of_few()) flaws.push_back(fmt::format("fewer than {} events", few_magnitudes));
    if (value.known() && !value.straight) flaws.emplace_back("not a straight line (at 5 %)");
    const std::string damping = range_text(tests, &EmissionFigures::damping_ratio, ""),
                      density = range_text(tests, &EmissionFigures::density, " kg/m²");
    if (!damping.empty()) physics.push_back("damping ratio " + damping);
    if (!density.empty()) physics.push_back("density " + density);
    std::vector<std::string> lines{value.known()
                                       ? fmt::format("<i>b</i> = {:.2f} ± {:.2f}", value.b, value.standard_error)
                                       : "too few events for <i>b</i>"};
    for (const auto& parts : {counts, flaws, physics})
        if (!parts.empty()) lines.push_back(in_one_line(parts));
    return lines;
}

double size_of_line(std::size_t number) { return number == 0 ? 1.0 : small_letters; }

double height_of(const Canvas& canvas, const std::vector<std::string>& lines) {
    double height = 3.0;  // height of the text in pt, including the distance to the frame
    for (std::size_t k = 0; k < lines.size(); ++k) height += 1.1 * canvas.size_of(lines[k], size_of_line(k)).height;
    return height;
}

/// Data for the diagram that shows the magnitudes of all tests together.
struct Magnitudes {
    std::vector<double> sorted;
    BValue value;
    std::vector<std::string> lines;
};

constexpr double at_least = 1.1, of_bin = 1.6;  // pt, radii of the marks

void draw_legend(Canvas& canvas, Point at) {
    const Colour white = colour("#ffffff");
    canvas.circle({at.x + 3.0, at.y}, at_least, &ink, nullptr, 0.0);
    const std::string above = "this magnitude or larger", within = "within 0.1";
    canvas.text({at.x + 8.0, at.y}, above, Across::left, Down::middle, 1.0, ink);
    const double next = at.x + 8.0 + canvas.size_of(above).width + 12.0;
    canvas.circle({next, at.y}, of_bin, &white, &faint, 0.7);
    canvas.text({next + 5.0, at.y}, within, Across::left, Down::middle, 1.0, ink);
}

void draw_magnitudes(Canvas& canvas, const Rect& place, const Magnitudes& all) {
    const std::vector<double>& magnitudes = all.sorted;
    const BValue& value = all.value;
    const auto count = static_cast<double>(magnitudes.size());
    Axes axes;
    axes.x = magnitudes.empty() ? magnitude_scale(-1.0, 0.0, 5)
                                : magnitude_scale(magnitudes.front(), magnitudes.back(), place.width < 300.0 ? 6 : 10);
    axes.y = scale_for(0.0, std::log10(std::max(count, 10.0)), 5);
    axes.y.low = -0.08 * axes.y.high;
    axes.y.step = axes.y.high > 2.5 ? 1.0 : 0.5;
    const double left = Axes::room_left(canvas, axes.y);
    double y = place.y + 1.4 * canvas.style().font_size;
    for (std::size_t k = 0; k < all.lines.size(); ++k) {
        const double size = size_of_line(k);
        canvas.text({place.x + beside_letter, y}, all.lines[k], Across::left, Down::top, size,
                    k == 0 && value.known() ? fitted : ink);
        y += 1.1 * canvas.size_of(all.lines[k], size).height;
    }
    const double top = y + 3.0;
    const double right = Axes::room_right(canvas, axes.x, place.width - left);
    axes.frame = {place.x + left, top, place.width - left - right, place.bottom() - Axes::room_below(canvas) - top};
    draw_legend(canvas, {place.x + beside_letter, place.y + 0.6 * canvas.style().font_size});
    const Colour white = colour("#ffffff");
    for (std::size_t k = 0; k < magnitudes.size();) {
        const double number = std::floor(magnitudes[k] / magnitude_bin);
        std::size_t end = k;
        while (end < magnitudes.size() && std::floor(magnitudes[end] / magnitude_bin) == number) ++end;
        const Point at = axes.at((number + 0.5) * magnitude_bin, std::log10(static_cast<double>(end - k)));
        canvas.circle(at, of_bin, &white, &faint, 0.7);
        k = end;
    }
    for (std::size_t k = 0; k < magnitudes.size(); ++k) {
        const Point at = axes.at(magnitudes[k], std::log10(count - static_cast<double>(k)));
        canvas.circle(at, at_least, &ink, nullptr, 0.0);
    }
    if (value.known()) {
        const double last =
            std::min(magnitudes.back(), value.a / value.b);  // magnitude at which the line reaches a single event
        canvas.line({axes.at(value.completeness, value.a - value.b * value.completeness),
                     axes.at(last, value.a - value.b * last)},
                    fitted, 1.2);
    }
    if (!std::isnan(value.completeness)) {
        canvas.line({axes.at(value.completeness, axes.y.low), axes.at(value.completeness, axes.y.high)}, faint, 0.6,
                    true);
    }
    axes.draw(canvas, "moment magnitude <i>M</i>", "log₁₀ of the number of events");
}

/// Colour of the viridis map, sampled at quarters. It goes from dark to bright, also if printed in grey.
Colour time_colour(double share) {
    static const std::array<Colour, 5> stops{colour("#440154"), colour("#3b528b"), colour("#21918c"), colour("#5ec962"),
                                             colour("#fde725")};
    const double at = std::clamp(share, 0.0, 1.0) * 4.0;
    const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
    const double rest = at - static_cast<double>(below);
    const Colour &a = stops[below], &b = stops[below + 1];
    return {std::lerp(a.red, b.red, rest), std::lerp(a.green, b.green, rest), std::lerp(a.blue, b.blue, rest)};
}

constexpr double least_radius = 0.6, largest_radius = 4.5;  // pt, radii of marks
constexpr double key_rows = 34.0;                           // pt, height of the map's legend

/// Scales for the colours and sizes of marks on a map.
struct MapScale {
    double first = 0.0, last = 0.0;        // range of axial strain
    double smallest = 0.0, largest = 0.0;  // range of magnitude

    double radius(double magnitude) const {
        const double share = largest > smallest ? (magnitude - smallest) / (largest - smallest) : 1.0;
        return std::lerp(least_radius, largest_radius, share * share);  // squared, so that most marks are small
    }
    Colour colour_at(double strain) const {
        return time_colour(last > first ? (strain - first) / (last - first) : 0.0);
    }
};

void draw_map_key(Canvas& canvas, const Rect& place, const MapScale& scale) {
    const double size = small_letters, line = canvas.size_of("X", size).height;
    const double bar = std::min(0.36 * place.width, 110.0), x = place.x + 0.06 * place.width;
    constexpr int pieces = 64;
    for (int k = 0; k < pieces; ++k)
        canvas.rectangle({x + bar * k / pieces, place.y + 3.0, bar / pieces + 0.3, 5.0},
                         time_colour((k + 0.5) / pieces));
    canvas.text({x, place.y + 9.5}, fmt::format("{:.3g}", scale.first / strain_unit), Across::centre, Down::top, size,
                ink);
    canvas.text({x + bar, place.y + 9.5}, fmt::format("{:.3g}", scale.last / strain_unit), Across::centre, Down::top,
                size, ink);
    canvas.text({x + 0.5 * bar, place.y + 9.5 + line}, strain_title, Across::centre, Down::top, size, ink);
    const double from = place.x + 0.56 * place.width, step = 0.14 * place.width;
    for (int k = 0; k < 3; ++k) {
        const double magnitude = std::lerp(scale.smallest, scale.largest, 0.5 * k);
        const Point at{from + step * k, place.y + 5.5};
        canvas.circle(at, scale.radius(magnitude), nullptr, &ink, 0.6);
        canvas.text({at.x, place.y + 11.0}, signed_number(magnitude, 1), Across::centre, Down::top, size, ink);
    }
    canvas.text({from + step, place.y + 11.0 + line}, "moment magnitude", Across::centre, Down::top, size, ink);
}

}  // namespace

bool has_emission(const TestResults& results) { return results.emission.has_value(); }

Panel magnitude_frequency(const std::vector<PlottedTest>& tests) {
    Magnitudes all{pooled(tests), {}, {}};
    all.value = fit_b_value(all.sorted, Completeness::maximum_curvature);
    all.lines = lines_of(all.value, tests, all.sorted.size());
    Panel panel;
    panel.height = [all](const Canvas& measure, double width) {
        return 0.55 * proportional(width) + height_of(measure, all.lines);
    };
    panel.draw = [all](Canvas& canvas, const Rect& place) { draw_magnitudes(canvas, place, all); };
    return panel;
}

Panel emission_map(std::vector<DrawnMoment> moments, const std::vector<std::filesystem::path>& folders) {
    MapScale scale{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const auto visit = [](const DrawnMoment& moment, auto&& with) {
        const NumberTable& table = *moment.recording->results.emission;
        const std::vector<double>&m = *table.find("moment_magnitude"), &strain = *table.find("axial_strain"),
              &x = *table.find("x"), &y = *table.find("y");
        for (std::size_t k = 0; k < m.size(); ++k)
            if (std::isfinite(m[k])) with(m[k], strain[k], Vec2{x[k], y[k]});
    };
    for (const DrawnMoment& moment : moments) {
        visit(moment, [&](double magnitude, double strain, Vec2 /*place*/) {
            scale.first = std::min(scale.first, strain);
            scale.last = std::max(scale.last, strain);
            scale.smallest = std::min(scale.smallest, magnitude);
            scale.largest = std::max(scale.largest, magnitude);
        });
    }
    for (DrawnMoment& moment : moments) {
        moment.cracks = false;
        visit(moment, [&](double magnitude, double strain, Vec2 place) {
            moment.marks.push_back({place, scale.radius(magnitude), scale.colour_at(strain)});
        });
        // Large marks are drawn first, so that smaller ones remain visible.
        std::ranges::stable_sort(moment.marks, std::ranges::greater{}, &DrawnMark::radius);
    }
    const bool some = scale.last >= scale.first;
    const Panel specimens = drawings(moments, folders, {});
    Panel panel;
    panel.letter_above = true;
    panel.height = [specimens, some](const Canvas& measure, double width) {
        return specimens.height(measure, width) + (some ? key_rows : 0.0);
    };
    panel.draw = [specimens, some, scale](Canvas& canvas, const Rect& place) {
        const double room = some ? key_rows : 0.0;
        specimens.draw(canvas, {place.x, place.y, place.width, place.height - room});
        if (some) draw_map_key(canvas, {place.x, place.bottom() - room, place.width, room}, scale);
    };
    return panel;
}

}  // namespace crackle::plot
