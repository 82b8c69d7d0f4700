// SPDX-License-Identifier: GPL-3.0-or-later
// Stress-strain curves and counts of breaks. Strains are shown in thousandths; stress and strain are positive in the
// sense of each test.
// Tested by tests/tools/commands/plot_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/plot/axes.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {
namespace {

constexpr double strain_unit = 1e-3;
constexpr const char* strain_title = "axial strain, 10⁻³";
constexpr double curve_width = 0.9, thin = 0.6;  // pt

// As in the report (tools/viewer/src/colours/theme.ts): distinguishable with any colour vision.
const std::array<Colour, 8> series{colour("#22262a"), colour("#00896b"), colour("#aa3377"), colour("#8a6d00"),
                                   colour("#6a51a3"), colour("#737a80"), colour("#a6611a"), colour("#33a3c2")};

const Colour& colour_of(const PlottedTest& test) { return series[test.colour % series.size()]; }

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

/// A curve's points; those that lie within a hundredth of a point of the line before are left out.
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

/// Samples of line and name, in rows that fit between the sides.
class Legend {
  public:
    struct Entry {
        std::string label;
        Colour colour;
        bool dashed = false, bar = false;
    };
    Legend(const Canvas& canvas, std::vector<Entry> entries, double width) : entries_(std::move(entries)) {
        line_ = 1.25 * canvas.size_of("Xy").height;
        double x = 0.0;
        for (const Entry& entry : entries_) {
            const double wide = sample + 3.0 + canvas.size_of(escaped(entry.label)).width + 10.0;
            if (x > 0.0 && x + wide - 10.0 > width) {
                x = 0.0;
                ++rows_;
            }
            places_.push_back({x, line_ * rows_});
            x += wide;
        }
    }
    double height() const { return entries_.size() < 2 ? 0.0 : line_ * (rows_ + 1) + 2.0; }
    void draw(Canvas& canvas, Point corner) const {
        if (entries_.size() < 2) return;
        for (std::size_t k = 0; k < entries_.size(); ++k) {
            const Entry& entry = entries_[k];
            const double x = corner.x + places_[k].x, middle = corner.y + places_[k].y + 0.5 * line_;
            if (entry.bar) {
                canvas.rectangle({x + 0.25 * sample, middle - 2.5, 0.5 * sample, 5.0}, entry.colour);
            } else {
                canvas.line({{x, middle}, {x + sample, middle}}, entry.colour, curve_width, entry.dashed);
            }
            canvas.text({x + sample + 3.0, middle}, escaped(entry.label), Across::left, Down::middle, 1.0, ink);
        }
    }

  private:
    static constexpr double sample = 14.0;  // pt
    std::vector<Entry> entries_;
    std::vector<Point> places_;
    double line_ = 0.0;
    int rows_ = 0;
};

std::vector<Legend::Entry> entries_of(const std::vector<PlottedTest>& tests) {
    std::vector<Legend::Entry> entries;
    entries.reserve(tests.size());
    for (const PlottedTest& test : tests) entries.push_back({test.label, colour_of(test), test.dashed});
    return entries;
}

constexpr double small_text = 0.75;  // of the font size

/// Breaks in equal intervals of strain: k width < strain <= (k + 1) width in the one of number k, as in the report.
struct Histogram {
    double width = 0.0;  // strain, a round number
    std::vector<int> tension, shear;
    int most = 0;

    std::string interval() const { return fmt::format("Δε = {:.6g}·10⁻³", width / strain_unit); }
};

/// 1, 2 or 5 times a power of ten that cuts the range into at most 60 intervals.
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

Scale strain_scale(const std::vector<PlottedTest>& tests, double width) {
    return scale_for(0.0, largest_of(tests, "axial_strain") / strain_unit, width < 300.0 ? 6 : 10);
}

/// Counts are whole: never a tick between them.
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
    const auto& summary = test.results->summary;
    const auto number = [&](const char* key) {
        const auto found = summary.find(key);
        return found != summary.end() && found->is_number() ? found->get<double>() : std::nan("");
    };
    const double strain = number("peak_strain"), stress = number("peak_stress");
    if (!std::isfinite(strain) || !std::isfinite(stress)) return;
    const Colour white = colour("#ffffff");
    canvas.circle(axes.at(strain / strain_unit, stress / unit), 1.8, &white, &colour_of(test), curve_width);
}

}  // namespace

Panel stress_strain(const std::vector<PlottedTest>& tests) {
    const bool single = tests.size() == 1;
    const auto strip = [single](double width) { return (single ? 0.23 : 0.2) * width; };
    Panel panel;
    panel.height = [strip](double width) { return 0.62 * width + strip(width); };
    panel.draw = [tests, strip, single](Canvas& canvas, const Rect& place) {
        const Unit unit = unit_for(largest_of(tests, "axial_stress"), "N/m");
        Axes upper, lower;
        upper.x = lower.x = strain_scale(tests, place.width);
        upper.y = scale_for(smallest_of(tests, "axial_stress") / unit.factor,
                            largest_of(tests, "axial_stress") / unit.factor, 6);
        const Histogram histogram = single ? count_breaks(*tests.front().results, total_strain(tests)) : Histogram{};
        lower.y = count_scale(single ? histogram.most : largest_of(tests, "bonds_broken"), 2);
        const double left = std::max(Axes::room_left(canvas, upper.y), Axes::room_left(canvas, lower.y));
        const Legend legend(canvas, entries_of(tests), place.width - left - 24.0);
        const double gap = (single ? 1.7 : 0.8) * canvas.style().font_size;  // of one: room for the interval
        // The letter of a panel stands beside the frame, where the uppermost number could be.
        const double top = place.y + std::max(legend.height(), 1.6 * canvas.style().font_size);
        const double bottom = place.bottom() - Axes::room_below(canvas);
        lower.frame = {place.x + left, bottom - strip(place.width) + gap, place.width - left - 4.0,
                       strip(place.width) - gap};
        upper.frame = {lower.frame.x, top, lower.frame.width, lower.frame.y - gap - top};

        legend.draw(canvas, {upper.frame.x + 20.0, place.y});
        if (upper.y.low < 0.0)
            canvas.line({upper.at(upper.x.low, 0.0), upper.at(upper.x.high, 0.0)}, colour("#c8ccd0"), 0.4);
        for (const PlottedTest& test : tests) {
            canvas.line(curve_points(upper, column(*test.results, "axial_strain"), strain_unit,
                                     column(*test.results, "axial_stress"), unit.factor),
                        colour_of(test), curve_width, test.dashed);
        }
        for (const PlottedTest& test : tests) mark_peak(canvas, upper, test, unit.factor);
        upper.draw(canvas, "", fmt::format("axial stress, {}", unit.name));
        if (single) {
            draw_bars(canvas, lower, histogram);
            canvas.text({lower.frame.right() - 2.0, lower.frame.y - 1.5}, "in " + histogram.interval(), Across::right,
                        Down::bottom, small_text);
        } else {
            draw_so_far(canvas, lower, tests);
        }
        lower.draw(canvas, strain_title, single ? "breaks" : "broken");
    };
    return panel;
}

Panel breaks(const std::vector<PlottedTest>& tests) {
    Panel panel;
    panel.height = [](double width) { return 0.5 * width; };
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
        const double left = Axes::room_left(canvas, axes.y), right = single ? Axes::room_left(canvas, so_far) : 4.0;
        const Legend legend(canvas, std::move(entries), place.width - left - right - 24.0);
        const double top = place.y + legend.height();
        axes.frame = {place.x + left, top, place.width - left - right, place.bottom() - Axes::room_below(canvas) - top};
        legend.draw(canvas, {axes.frame.x + 20.0, place.y});
        if (single) {
            draw_bars(canvas, axes, histogram);
            Axes second = axes;
            second.y = so_far;
            PlottedTest test = tests.front();
            test.colour = 0;
            draw_so_far(canvas, second, {test});
            axes.draw(canvas, strain_title, "bonds broken");
            axes.draw_right(canvas, so_far, "so far");
        } else {
            draw_so_far(canvas, axes, tests);
            axes.draw(canvas, strain_title, "bonds broken so far");
        }
    };
    return panel;
}

}  // namespace crackle::plot
