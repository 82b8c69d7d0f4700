// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/campaign_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "specimens/recordings/curve_points.hpp"
#include "specimens/statistics/mean.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

/// A row's label, broken after commas into lines of at most this width, pt. Longer parts are not broken.
std::string broken(const Canvas& canvas, const std::string& label, double text, double width) {
    std::string all, line;
    for (std::size_t at = 0; at < label.size();) {
        const std::size_t comma = label.find(", ", at), end = comma == std::string::npos ? label.size() : comma + 2;
        const std::string part = label.substr(at, end - at);
        if (!line.empty() && canvas.size_of(escaped(line + part), text).width > width) {
            all += line.substr(0, line.size() - 1) + '\n';
            line.clear();
        }
        line += part;
        at = end;
    }
    return all + line;
}

/// Labels next to the rows of a panel of a given width.
struct RowLabels {
    static constexpr double text = 0.85;  // text size relative to the font size

    std::vector<std::string> markup;
    double width = 0.0, height = 0.0;  // pt, size of the largest label
};

RowLabels labels_of(const Canvas& canvas, const std::vector<Sample>& samples, double panel_width) {
    constexpr double widest = 0.4;  // largest width of labels, relative to the panel's width
    RowLabels labels;
    for (const Sample& sample : samples) {
        labels.markup.push_back(escaped(broken(canvas, sample.label, RowLabels::text, widest * panel_width)));
        const TextSize size = canvas.size_of(labels.markup.back(), RowLabels::text);
        labels.width = std::max(labels.width, size.width);
        labels.height = std::max(labels.height, size.height);
    }
    labels.width = std::min(labels.width, widest * panel_width);
    return labels;
}

/// A scale that starts near the smallest value if this is far from 0; unlike for curves, 0 need not be included.
Scale figure_scale(double smallest, double largest, int ticks) {
    constexpr double near_zero = 0.35;
    if (smallest <= 0.0 || largest - smallest > (1.0 - near_zero) * largest) return scale_for(smallest, largest, ticks);
    const double range = std::max(largest - smallest, 1e-3 * largest);
    Scale scale = scale_for(0.0, range, ticks);
    scale.low = smallest - 0.08 * range;
    scale.high = largest + 0.08 * range;
    return scale;
}

/// Legend entries of curve bundles or of series.
template <class Labelled>
std::vector<Legend::Entry> entries_of_labels(const std::vector<Labelled>& all) {
    std::vector<Legend::Entry> entries;
    for (std::size_t k = 0; k < all.size(); ++k) entries.push_back({all[k].label, series_colour(k), false, false});
    return entries;
}

/// Draws values as dots, and over them the means, joined by a line if requested. @param x_unit, y_unit values by which
/// x and y are divided
void draw_series(Canvas& canvas, const Axes& axes, const Series& series, const Colour& colour, double x_unit,
                 double y_unit) {
    const Colour faint = tinted(colour, 0.45);
    const auto at = [&](std::size_t k, double value) { return axes.at(series.x[k] / x_unit, value / y_unit); };
    std::vector<Point> means;
    for (std::size_t k = 0; k < series.x.size(); ++k) {
        const Sample& sample = series.samples[k];
        for (const double value : sample.values) canvas.circle(at(k, value), 1.0, &faint, nullptr, 0.0);
        if (std::isfinite(sample.mean)) means.push_back(at(k, sample.mean));
    }
    std::sort(means.begin(), means.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    if (series.joined) canvas.line(means, colour, curve_width);
    for (std::size_t k = 0; k < series.x.size(); ++k) {
        const Sample& sample = series.samples[k];
        if (std::isfinite(sample.mean))
            draw_mean(canvas, at(k, sample.mean), at(k, sample.low), at(k, sample.high), colour, false);
    }
}

/// Range of the values and of the intervals. Intervals that would make the range of the values more than three times
/// as long, such as those of two packings, are cut off.
Range range_of(const std::vector<Sample>& samples) {
    Range range;
    for (const Sample& sample : samples) range.include(sample.values);
    if (!std::isfinite(range.low)) return {0.0, 0.0};
    const double most = 3.0 * (range.high - range.low);
    Range whole = range;
    for (const Sample& sample : samples)
        if (sample.high - sample.low <= most) whole.include({sample.low, sample.high});
    return whole;
}

}  // namespace

Unit figure_unit(double largest, const std::string& name) {
    constexpr double small = 0.02;
    if (!name.empty()) return unit_for(largest, name);
    return largest > 0.0 && largest < small ? Unit{strain_unit, strain_unit_title} : Unit{1.0, ""};
}

Band band_of(const CurveBundle& bundle, double share, std::size_t strains) {
    std::vector<double> ends;
    for (const auto& curve : bundle.curves)
        if (!curve.empty()) ends.push_back(std::ranges::max_element(curve)->first);
    Band band;
    if (ends.empty()) return band;
    std::sort(ends.begin(), ends.end());
    const double last = ends[(ends.size() - 1) / 2];
    for (std::size_t k = 0; k < strains; ++k) {
        const double strain = last * static_cast<double>(k) / static_cast<double>(strains - 1);
        std::vector<double> values;
        for (const auto& curve : bundle.curves) {
            const double stress = curve.empty() ? std::nan("") : stress_at(curve, strain);
            if (std::isfinite(stress)) values.push_back(stress);
        }
        std::sort(values.begin(), values.end());
        band.strain.push_back(strain);
        band.low.push_back(percentile(values, share));
        band.median.push_back(percentile(values, 0.5));
        band.high.push_back(percentile(values, 1.0 - share));
    }
    return band;
}

Panel curve_bands(const std::vector<CurveBundle>& bundles, const std::vector<LabelledCurve>& measured) {
    const auto entries = [bundles, measured] {
        std::vector<Legend::Entry> all = entries_of_labels(bundles);
        for (const LabelledCurve& curve : measured) all.push_back({curve.label, ink, true, false});
        return all;
    };
    Panel panel;
    panel.height = [entries](const Canvas& measure, double width) {
        return 0.62 * proportional(width) + legend_of(measure, entries(), width).more_rows();
    };
    panel.draw = [bundles, measured, entries](Canvas& canvas, const Rect& place) {
        std::vector<Band> bands;
        Range strains{0.0, 0.0}, lows{0.0, 0.0}, highs{0.0, 0.0};
        for (const LabelledCurve& curve : measured) {
            for (const auto& [strain, stress] : curve.points) {
                strains.high = std::max(strains.high, strain);
                highs.high = std::max(highs.high, stress);
            }
        }
        for (const CurveBundle& bundle : bundles) {
            bands.push_back(band_of(bundle));
            strains.include(bands.back().strain);
            lows.include(bands.back().low);
            highs.include(bands.back().high);
        }
        const Unit unit = unit_for(highs.high, bundles.empty() ? "N/m" : bundles.front().stress_unit);
        Axes axes;
        axes.x = scale_for(0.0, strains.high / strain_unit, place.width < 300.0 ? 6 : 10);
        axes.y = scale_for(lows.low / unit.factor, highs.high / unit.factor, 6);
        draw_legend_above(canvas, place, legend_of(canvas, entries(), place.width), axes);
        const auto line = [&](const Band& band, const std::vector<double>& values) {
            std::vector<Point> points;
            for (std::size_t k = 0; k < values.size(); ++k)
                points.push_back(axes.at(band.strain[k] / strain_unit, values[k] / unit.factor));
            return points;
        };
        for (std::size_t b = 0; b < bands.size(); ++b) {
            std::vector<Point> outline = line(bands[b], bands[b].low);
            const std::vector<Point> upper = line(bands[b], bands[b].high);
            outline.insert(outline.end(), upper.rbegin(), upper.rend());
            const Colour fill = tinted(series_colour(b), 0.18), edge = tinted(series_colour(b), 0.45);
            if (outline.size() > 2) canvas.polygon(outline, &fill, &edge, 0.3);
        }
        for (std::size_t b = 0; b < bands.size(); ++b)
            canvas.line(line(bands[b], bands[b].median), series_colour(b), 1.3 * curve_width);
        for (const LabelledCurve& curve : measured) {
            std::vector<Point> points;
            points.reserve(curve.points.size());
            for (const auto& [at, stress] : curve.points)
                points.push_back(axes.at(at / strain_unit, stress / unit.factor));
            canvas.line(points, ink, 1.3 * curve_width, true);
        }
        const CurveNames names = names_of_kind(from_name<LoadingKind>(bundles.empty() ? "" : bundles.front().kind));
        axes.draw(canvas, titled(names.strain, strain_unit_title), titled(names.stress, unit.name));
    };
    return panel;
}

Panel distributions(const std::string& title, const std::string& unit_name, const std::vector<Sample>& samples) {
    Panel panel;
    panel.height = [samples](const Canvas& measure, double width) {
        // Height of a row and of the space between labels, relative to the font size.
        constexpr double row = 2.6, between = 0.6;
        const double size = measure.style().font_size;
        const double rows = std::max(row * size, labels_of(measure, samples, width).height + between * size);
        return rows * static_cast<double>(samples.size()) + Axes::room_below(measure) + 1.6 * size;
    };
    panel.draw = [title, unit_name, samples](Canvas& canvas, const Rect& place) {
        const Range range = range_of(samples);
        const Unit unit = figure_unit(range.high, unit_name);
        const RowLabels labels = labels_of(canvas, samples, place.width);
        Axes axes;
        axes.x = figure_scale(range.low / unit.factor, range.high / unit.factor, place.width < 300.0 ? 5 : 8);
        // Rows have names instead of ticks.
        axes.y = {1e-3, static_cast<double>(std::max<std::size_t>(1, samples.size())), 1e4};
        const double top = place.y + 1.6 * canvas.style().font_size;
        const double left = labels.width + 8.0, right = Axes::room_right(canvas, axes.x, place.width - left);
        axes.frame = {place.x + left, top, place.width - left - right, place.bottom() - Axes::room_below(canvas) - top};
        for (std::size_t s = 0; s < samples.size(); ++s) {
            const double middle = static_cast<double>(samples.size() - s) - 0.5;
            const Colour &colour = series_colour(s), faint = tinted(colour, 0.55);
            for (const double value : samples[s].values)
                canvas.circle(axes.at(value / unit.factor, middle - 0.17), 1.3, &faint, nullptr, 0.0);
            const auto at = [&](double value) { return axes.at(value / unit.factor, middle + 0.2); };
            canvas.clip(axes.frame);
            if (std::isfinite(samples[s].mean))
                draw_mean(canvas, at(samples[s].mean), at(samples[s].low), at(samples[s].high), colour, true);
            canvas.unclip();
            double text = RowLabels::text;  // text sizes are rounded, so the text may still be too wide after scaling
            while (canvas.size_of(labels.markup[s], text).width > labels.width) text *= 0.95;
            canvas.text({axes.frame.x - 5.0, axes.at(axes.x.low, middle).y}, labels.markup[s], Across::right,
                        Down::middle, text, ink);
        }
        for (const double tick : axes.x.ticks()) {
            const Point mark = axes.at(tick, axes.y.low);
            canvas.line({mark, {mark.x, axes.frame.y}}, plot::colour("#e3e6e9"), 0.3);
        }
        axes.draw(canvas, titled(title, unit.name), "");
    };
    return panel;
}

Panel over_axis(const std::string& x_title, const std::string& x_unit, const std::string& y_title,
                const std::string& y_unit, const std::vector<Series>& all) {
    Panel panel;
    panel.height = [all](const Canvas& measure, double width) {
        return 0.55 * proportional(width) + legend_of(measure, entries_of_labels(all), width).more_rows();
    };
    panel.draw = [=](Canvas& canvas, const Rect& place) {
        Range x;
        std::vector<Sample> samples;
        for (const Series& series : all) {
            x.include(series.x);
            samples.insert(samples.end(), series.samples.begin(), series.samples.end());
        }
        const Range y = range_of(samples);
        if (y.size() == 0.0) x = y;
        const Unit unit = figure_unit(y.high, y_unit);
        // Stresses and lengths get SI prefixes; other units get a power of ten.
        const bool has_prefix = x_unit == "Pa" || x_unit == "N/m" || x_unit == "m";
        const Unit unit_x = has_prefix ? unit_for(x.high, x_unit) : Unit{1.0, x_unit};
        const double power = has_prefix ? unit_x.factor
                             : x.high > 0.0 && (x.high >= 1e4 || x.high < 1e-2)
                                 ? std::pow(10.0, std::floor(std::log10(x.high)))
                                 : 1.0;
        Axes axes;
        axes.x = figure_scale(x.low / power, x.high / power, place.width < 300.0 ? 5 : 8);
        axes.y = figure_scale(y.low / unit.factor, y.high / unit.factor, 5);
        draw_legend_above(canvas, place, legend_of(canvas, entries_of_labels(all), place.width), axes);
        // The interval from only two packings may be many times larger than the rest of the diagram.
        canvas.clip(axes.frame);
        for (std::size_t s = 0; s < all.size(); ++s)
            draw_series(canvas, axes, all[s], series_colour(s), power, unit.factor);
        canvas.unclip();
        std::string title_x = titled(x_title, unit_x.name);
        if (!has_prefix && power != 1.0)
            title_x += fmt::format(", 10<sup>{}</sup>", static_cast<int>(std::log10(power)));
        axes.draw(canvas, title_x, titled(y_title, unit.name));
    };
    return panel;
}

}  // namespace crackle::plot
