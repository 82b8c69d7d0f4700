// SPDX-License-Identifier: GPL-3.0-or-later
// Stress-strain curves and numbers of breaks. Strains are shown in thousandths. Stress and strain are positive in the
// direction in which the test loads.
// Tested by tests/tools/commands/plot_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

constexpr double small_text = 0.75;  // size of small text, relative to the font size

/// Breaks per strain interval. Interval k is k width < strain <= (k + 1) width, as on the report page.
struct Histogram {
    double width = 0.0;  // width of a strain interval, a round number
    std::vector<int> tension, shear;
    int most = 0;

    std::string interval() const { return fmt::format("Δε = {:.6g} ‰", width / strain_unit); }
};

/// Interval width of the form 1, 2 or 5 times a power of ten, with at most 60 intervals in the range.
double interval_width(double range) {
    const double least = range / 60.0, power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least * (1.0 - 1e-9)) return step * power;
    }
    return 10.0 * power;
}

Histogram count_breaks(const TestResults& results, double range) {
    Histogram histogram;
    histogram.width = interval_width(std::max(range, 1e-12));
    const auto intervals = static_cast<std::size_t>(std::max(1.0, std::ceil(range / histogram.width - 1e-9)));
    histogram.tension.resize(intervals);
    histogram.shear.resize(intervals);
    const std::vector<double>&strain = *results.events.find("axial_strain"), &shear = *results.events.find("mode");
    for (std::size_t k = 0; k < strain.size(); ++k) {
        const double last = static_cast<double>(intervals - 1);
        const auto at =
            static_cast<std::size_t>(std::clamp(std::ceil(strain[k] / histogram.width - 1e-9) - 1.0, 0.0, last));
        ++(shear[k] != 0.0 ? histogram.shear : histogram.tension)[at];
    }
    for (std::size_t k = 0; k < intervals; ++k)
        histogram.most = std::max(histogram.most, histogram.tension[k] + histogram.shear[k]);
    return histogram;
}

void draw_bars(Canvas& canvas, const Axes& axes, const Histogram& histogram) {
    for (std::size_t k = 0; k < histogram.tension.size(); ++k) {
        const double left = static_cast<double>(k) * histogram.width / strain_unit;
        const double right = std::min(left + histogram.width / strain_unit, axes.x.high);
        double below = 0.0;
        const auto bar = [&](int count, const Colour& fill) {
            if (count == 0) return;
            const Point foot = axes.at(left, below), top = axes.at(right, below + count);
            canvas.rectangle({foot.x, top.y, 0.9 * (top.x - foot.x), foot.y - top.y}, fill);
            below += count;
        };
        bar(histogram.tension[k], tension_colour);
        bar(histogram.shear[k], shear_colour);
    }
}

/// Scale for counts, with ticks only at integers.
Scale count_scale(double most, int ticks) {
    Scale scale = scale_for(0.0, std::max(most, 1.0), ticks);
    scale.step = std::max(1.0, scale.step);
    return scale;
}

void draw_so_far(Canvas& canvas, const Axes& axes, const std::vector<PlottedTest>& tests) {
    for (const PlottedTest& test : tests) {
        canvas.line(curve_points(axes, column(*test.results, "axial_strain"), strain_unit,
                                 column(*test.results, "bonds_broken"), 1.0),
                    colour_of(test), curve_width, test.dashed);
    }
}

double total_strain(const std::vector<PlottedTest>& tests) { return largest_of(tests, "axial_strain"); }

void mark_peak(Canvas& canvas, const Axes& axes, const PlottedTest& test, double unit) {
    const Strength& known = test.results->summary.strength;
    if (!known.peak_strain || !known.peak_stress) return;
    const Colour white = colour("#ffffff");
    canvas.circle(axes.at(*known.peak_strain / strain_unit, *known.peak_stress / unit), 1.8, &white, &colour_of(test),
                  curve_width);
}

/// Points along the curves, spaced by at most `apart`, pt.
std::vector<Point> places_along(const Axes& axes, const std::vector<PlottedTest>& tests, double unit, double apart) {
    std::vector<Point> places;
    for (const PlottedTest& test : tests) {
        const std::vector<Point> points = curve_points(axes, column(*test.results, "axial_strain"), strain_unit,
                                                       column(*test.results, "axial_stress"), unit);
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const Point a = points[k], b = points[k + 1];
            const double parts = std::max(1.0, std::ceil(std::hypot(b.x - a.x, b.y - a.y) / apart));
            for (double part = 0.0; part <= parts; ++part)
                places.push_back({a.x + part / parts * (b.x - a.x), a.y + part / parts * (b.y - a.y)});
        }
    }
    return places;
}

bool is_free(const Rect& rect, const std::vector<Point>& taken, double off) {
    return std::ranges::none_of(taken, [&](const Point& p) {
        return p.x > rect.x - off && p.x < rect.right() + off && p.y > rect.y - off && p.y < rect.bottom() + off;
    });
}

/// Position for a label near a mark, where it covers neither a curve nor another label. Tried in this order: above to
/// the left, below to the right, farther away. The area is then marked as taken.
Rect label_place(const Rect& frame, Point mark, const TextSize& size, std::vector<Point>& taken) {
    constexpr double beside = 2.5, farther = 3.0, off = 0.5;  // pt
    Rect best{mark.x + beside, mark.y + beside, size.width, size.height};
    const auto try_at = [&](double step) {
        const double x = beside + step, y = 0.5 * step;
        for (const Rect& rect : {Rect{mark.x - x - size.width, mark.y - y - size.height, size.width, size.height},
                                 Rect{mark.x + x, mark.y + y, size.width, size.height}}) {
            const bool inside = rect.x > frame.x + 1.0 && rect.right() < frame.right() && rect.y > frame.y &&
                                rect.bottom() < frame.bottom() - 1.0;
            if (!inside || !is_free(rect, taken, off)) continue;
            best = rect;
            return true;
        }
        return false;
    };
    for (int step = 0; step < 6 && !try_at(farther * step); ++step) {
    }
    for (const double across : {0.0, 0.25, 0.5, 0.75, 1.0})
        for (const double down : {0.0, 0.5, 1.0})
            taken.push_back({best.x + across * best.width, best.y + down * best.height});
    return best;
}

/// Marks crack initiation and crack damage where the curve first reaches the corresponding stresses.
void mark_cracks(Canvas& canvas, const Axes& axes, const PlottedTest& test, double unit) {
    const Colour white = colour("#ffffff");
    std::vector<Point> taken = places_along(axes, {test}, unit, 1.0);
    const std::vector<double>&strain = column(*test.results, "axial_strain"),
          &stress = column(*test.results, "axial_stress");
    const CrackingFigures& known = test.results->summary.cracking;
    for (const auto& [level, name] : {std::pair(known.crack_initiation_stress.or_nan(), crack_initiation_sign),
                                      std::pair(known.crack_damage_stress.or_nan(), crack_damage_sign)}) {
        const auto reached = std::ranges::find_if(stress, [level = level](double s) { return s >= level; });
        if (reached == stress.end()) continue;  // also if the stress of the mark is NaN
        const auto row = static_cast<std::size_t>(reached - stress.begin());
        const Point place = axes.at(strain[row] / strain_unit, *reached / unit);
        canvas.circle(place, 1.5, &white, &colour_of(test), 0.7 * curve_width);
        const Rect label = label_place(axes.frame, place, canvas.size_of(name, small_text), taken);
        canvas.text({label.x, label.y}, name, Across::left, Down::top, small_text, ink);
    }
}

void draw_curves(Canvas& canvas, const Axes& axes, const std::vector<PlottedTest>& tests, double unit) {
    if (axes.y.low < 0.0) canvas.line({axes.at(axes.x.low, 0.0), axes.at(axes.x.high, 0.0)}, colour("#c8ccd0"), 0.4);
    for (const PlottedTest& test : tests) {
        canvas.line(curve_points(axes, column(*test.results, "axial_strain"), strain_unit,
                                 column(*test.results, "axial_stress"), unit),
                    colour_of(test), curve_width, test.dashed);
    }
    for (const PlottedTest& test : tests) mark_peak(canvas, axes, test, unit);
    if (tests.size() == 1) mark_cracks(canvas, axes, tests.front(), unit);
}

/// Largest strain and stress of measured curves, at least 0.
std::pair<double, double> largest_measured(const std::vector<LabelledCurve>& measured) {
    std::pair<double, double> largest;
    for (const LabelledCurve& curve : measured) {
        for (const auto& [strain, stress] : curve.points) {
            largest.first = std::max(largest.first, strain);
            largest.second = std::max(largest.second, stress);
        }
    }
    return largest;
}

void draw_measured(Canvas& canvas, const Axes& axes, const std::vector<LabelledCurve>& measured, double unit) {
    for (const LabelledCurve& curve : measured) {
        std::vector<Point> points;
        for (const auto& [strain, stress] : curve.points)
            points.push_back(axes.at(strain / strain_unit, stress / unit));
        canvas.line(points, ink, curve_width, true);
    }
}

std::vector<Legend::Entry> entries_with(const std::vector<PlottedTest>& tests,
                                        const std::vector<LabelledCurve>& measured) {
    std::vector<Legend::Entry> entries = entries_of(tests);
    for (const LabelledCurve& curve : measured) entries.push_back({curve.label, ink, true});
    return entries;
}

Scale stress_scale(const std::vector<PlottedTest>& tests, double unit, int ticks) {
    return scale_for(smallest_of(tests, "axial_stress") / unit, largest_of(tests, "axial_stress") / unit, ticks);
}

/// Tests of one kind of loading whose curves are hard to see on the common scales; usually empty.
std::vector<PlottedTest> slivers_of(const std::vector<PlottedTest>& tests) {
    // Values below which curves are hard to see, relative to the largest of all tests.
    constexpr double least_stress = 0.25, least_strain = 0.2;
    std::array<std::vector<PlottedTest>, 2> kinds;
    for (const PlottedTest& test : tests) kinds[pulled(*test.results) ? 0 : 1].push_back(test);
    if (kinds[0].empty() || kinds[1].empty()) return {};
    const std::vector<PlottedTest>& weaker =
        largest_of(kinds[0], "axial_stress") < largest_of(kinds[1], "axial_stress") ? kinds[0] : kinds[1];
    const auto share = [&](const char* name) { return largest_of(weaker, name) / largest_of(tests, name); };
    return share("axial_stress") < least_stress || share("axial_strain") < least_strain ? weaker
                                                                                        : std::vector<PlottedTest>();
}

/// A free area of the given size within the frame that no curve crosses: the lowest one and, among the lowest, the
/// rightmost.
std::optional<Rect> free_place(const Axes& axes, const std::vector<PlottedTest>& tests, double unit, double width,
                               double height) {
    constexpr double off = 4.0, stride = 3.0;  // pt: distance from curves, step between trial positions
    const std::vector<Point> taken = places_along(axes, tests, unit, off);
    const Rect& frame = axes.frame;
    for (double y = frame.bottom() - off - height; y >= frame.y; y -= stride) {
        for (double x = frame.right() - off - width; x >= frame.x + off; x -= stride) {
            if (is_free({x, y, width, height}, taken, off)) return Rect{x, y, width, height};
        }
    }
    return std::nullopt;
}

/// The largest free place for an inset of a readable size, if any.
std::optional<Rect> place_of_inset(const Axes& axes, const std::vector<PlottedTest>& tests, double unit) {
    std::optional<Rect> best;
    double largest = 0.0;
    for (const double across : {0.6, 0.52, 0.45, 0.38}) {
        for (const double up : {0.75, 0.65, 0.55, 0.45}) {
            const double width = std::min(across * axes.frame.width, 170.0), height = up * axes.frame.height;
            if (width * height <= largest) continue;
            if (const auto found = free_place(axes, tests, unit, width, height)) {
                best = found;
                largest = width * height;
            }
        }
    }
    return best;
}

/// Unit of stress: Pa in tests with material_units = "area", otherwise N/m.
std::string stress_unit(const std::vector<PlottedTest>& tests) {
    const auto in_area = [](const PlottedTest& test) {
        return test.results->summary.about.material_units == StiffnessUnits::area;
    };
    if (std::ranges::none_of(tests, in_area)) return "N/m";
    return std::ranges::all_of(tests, in_area) ? "Pa" : "N/m or Pa";
}

/// Draws the curves of some tests inside a rectangle, with their own scales.
void draw_inset(Canvas& canvas, const Rect& place, const std::vector<PlottedTest>& tests) {
    canvas.rectangle(place, colour("#ffffff"));
    const Unit unit = unit_for(largest_of(tests, "axial_stress"), stress_unit(tests));
    Axes axes;
    axes.text = small_text;
    axes.x = scale_for(0.0, largest_of(tests, "axial_strain") / strain_unit, 3);
    axes.y = stress_scale(tests, unit.factor, 4);
    const double left = Axes::room_left(canvas, axes.y, small_text), line = canvas.size_of("X", small_text).height;
    axes.frame = {place.x + left, place.y + 1.3 * line, place.width - left - 3.0,
                  place.height - 1.3 * line - Axes::room_below(canvas, small_text)};
    canvas.text({axes.frame.x + 0.5 * axes.frame.width, place.y}, tests.front().results->summary.about.kind.name(),
                Across::centre, Down::top, small_text, ink);
    draw_curves(canvas, axes, tests, unit.factor);
    axes.draw(canvas, strain_unit_title, unit.name);
}

}  // namespace

Panel stress_strain(const std::vector<PlottedTest>& tests, const std::vector<LabelledCurve>& measured) {
    const bool single = tests.size() == 1;
    const auto strip = [single](double width) { return (single ? 0.23 : 0.2) * proportional(width); };
    Panel panel;
    panel.height = [strip, tests, measured](const Canvas& measure, double width) {
        return 0.62 * proportional(width) + strip(width) +
               legend_of(measure, entries_with(tests, measured), width).more_rows();
    };
    panel.draw = [tests, measured, strip, single](Canvas& canvas, const Rect& place) {
        const auto [measured_strain, measured_stress] = largest_measured(measured);
        const double most_stress = std::max(largest_of(tests, "axial_stress"), measured_stress);
        const Unit unit = unit_for(most_stress, stress_unit(tests));
        Axes upper, lower;
        upper.x = lower.x = strain_scale(tests, place.width, measured_strain);
        upper.y = scale_for(smallest_of(tests, "axial_stress") / unit.factor, most_stress / unit.factor, 6);
        const Histogram histogram = single ? count_breaks(*tests.front().results, total_strain(tests)) : Histogram{};
        lower.y = count_scale(single ? histogram.most : largest_of(tests, "bonds_broken"), 2);
        const double left = std::max(Axes::room_left(canvas, upper.y), Axes::room_left(canvas, lower.y));
        const Legend legend = legend_of(canvas, entries_with(tests, measured), place.width);
        // With a single test, space is needed for the text that states the strain interval.
        const double gap = (single ? 1.7 : 0.8) * canvas.style().font_size;
        // The panel's letter is beside the frame, where it could overlap the uppermost number.
        const double top = place.y + std::max(legend.height(), 1.6 * canvas.style().font_size);
        const double bottom = place.bottom() - Axes::room_below(canvas);
        const double right = Axes::room_right(canvas, lower.x, place.width - left);
        lower.frame = {place.x + left, bottom - strip(place.width) + gap, place.width - left - right,
                       strip(place.width) - gap};
        upper.frame = {lower.frame.x, top, lower.frame.width, lower.frame.y - gap - top};
        const std::vector<PlottedTest> slivers = measured.empty() ? slivers_of(tests) : std::vector<PlottedTest>();
        std::optional<Rect> inset;
        if (!slivers.empty()) {
            inset = place_of_inset(upper, tests, unit.factor);
            if (!inset) {  // there is no free area, so the inset is placed beside the curves
                const double whole = upper.frame.width;
                lower.frame.width = upper.frame.width = 0.56 * whole;
                inset = Rect{upper.frame.right() + 0.03 * whole, upper.frame.y, 0.41 * whole, upper.frame.height};
            }
        }

        legend.draw(canvas, {place.x + beside_letter, place.y});
        draw_curves(canvas, upper, tests, unit.factor);
        draw_measured(canvas, upper, measured, unit.factor);
        if (inset) draw_inset(canvas, *inset, slivers);
        upper.draw(canvas, "", fmt::format("{}, {}", names_of(tests).stress, unit.name));
        if (single) {
            draw_bars(canvas, lower, histogram);
            canvas.text({lower.frame.right() - 2.0, lower.frame.y - 1.5}, "in " + histogram.interval(), Across::right,
                        Down::bottom, small_text);
        } else {
            draw_so_far(canvas, lower, tests);
        }
        lower.draw(canvas, fmt::format("{}, {}", names_of(tests).strain, strain_unit_title),
                   single ? "breaks" : "broken");
    };
    return panel;
}

Panel breaks(const std::vector<PlottedTest>& tests) {
    Panel panel;
    panel.height = [tests](const Canvas& measure, double width) {
        return 0.5 * proportional(width) +
               (tests.size() == 1 ? 0.0 : legend_of(measure, entries_of(tests), width).more_rows());
    };
    panel.draw = [tests](Canvas& canvas, const Rect& place) {
        const bool single = tests.size() == 1;
        const Histogram histogram = single ? count_breaks(*tests.front().results, total_strain(tests)) : Histogram{};
        Axes axes;
        axes.x = strain_scale(tests, place.width);
        axes.y = count_scale(single ? histogram.most : largest_of(tests, "bonds_broken"), 5);
        const Scale so_far = count_scale(largest_of(tests, "bonds_broken"), 5);
        std::vector<Legend::Entry> entries = entries_of(tests);
        if (single) {
            entries = {{"tension", tension_colour, false, true}, {"so far", ink, false, false}};
            entries.front().label += ", in " + histogram.interval();
            const bool any_shear =
                std::any_of(histogram.shear.begin(), histogram.shear.end(), [](int n) { return n > 0; });
            if (any_shear) entries.insert(entries.begin() + 1, {"shear", shear_colour, false, true});
        }
        const double left = Axes::room_left(canvas, axes.y);
        const double right =
            single ? Axes::room_left(canvas, so_far) : Axes::room_right(canvas, axes.x, place.width - left);
        const Legend legend = legend_of(canvas, std::move(entries), place.width);
        const double top = place.y + legend.height();
        axes.frame = {place.x + left, top, place.width - left - right, place.bottom() - Axes::room_below(canvas) - top};
        legend.draw(canvas, {place.x + beside_letter, place.y});
        if (single) {
            draw_bars(canvas, axes, histogram);
            Axes second = axes;
            second.y = so_far;
            PlottedTest test = tests.front();
            test.colour = 0;
            draw_so_far(canvas, second, {test});
            axes.draw(canvas, fmt::format("{}, {}", names_of(tests).strain, strain_unit_title), "bonds broken");
            axes.draw_right(canvas, so_far, "so far");
        } else {
            draw_so_far(canvas, axes, tests);
            axes.draw(canvas, fmt::format("{}, {}", names_of(tests).strain, strain_unit_title), "bonds broken so far");
        }
    };
    return panel;
}

}  // namespace crackle::plot
