// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/legend.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace crackle::plot {

const Colour& series_colour(std::size_t number) {
    static const std::array<Colour, 8> series{colour("#22262a"), colour("#00896b"), colour("#aa3377"),
                                              colour("#8a6d00"), colour("#6a51a3"), colour("#737a80"),
                                              colour("#a6611a"), colour("#33a3c2")};
    return series[number % series.size()];
}

Colour tinted(const Colour& colour, double share) {
    const auto mixed = [&](double part) { return 1.0 - share * (1.0 - part); };
    return {mixed(colour.red), mixed(colour.green), mixed(colour.blue)};
}

std::string indexed(const char* letter, const char* index) {
    return fmt::format("<i>{}</i><span size=\"75%\" rise=\"-2pt\">{}</span>", letter, index);
}

std::string titled(const std::string& title, const std::string& unit) {
    return unit.empty() ? title : title + ", " + unit;
}

void draw_mean(Canvas& canvas, Point mean, Point low, Point high, const Colour& colour, bool across) {
    const Colour white = plot::colour("#ffffff");
    constexpr double cap = 2.5;  // pt
    if (std::isfinite(low.x) && std::isfinite(low.y) && std::isfinite(high.x) && std::isfinite(high.y)) {
        canvas.line({low, high}, colour, curve_width);
        for (const Point& end : {low, high}) {
            if (across)
                canvas.line({{end.x, end.y - cap}, {end.x, end.y + cap}}, colour, curve_width);
            else
                canvas.line({{end.x - cap, end.y}, {end.x + cap, end.y}}, colour, curve_width);
        }
    }
    canvas.circle(mean, 2.2, &white, &colour, curve_width);
}

Legend::Legend(const Canvas& canvas, std::vector<Entry> entries, double width) : entries_(std::move(entries)) {
    constexpr double between = 10.0;  // pt
    double widest = 0.0;
    const auto measure = [&] {
        line_ = 1.25 * canvas.size_of("Xy", text_).height;
        for (const Entry& entry : entries_)
            widest = std::max(widest, sample + 3.0 + canvas.size_of(escaped(entry.label), text_).width + between);
        return static_cast<std::size_t>(std::max(1.0, std::floor((width + between) / widest)));
    };
    std::size_t columns = measure();
    if (columns <
        std::min<std::size_t>(2, entries_.size())) {  // use smaller letters if that makes room for a second column
        text_ = 0.85;
        widest = 0.0;
        columns = measure();
    }
    if (widest - between > width) {
        text_ *= width / (widest - between);
        widest = 0.0;
        columns = measure();
    }
    columns = std::min(columns, std::max<std::size_t>(1, entries_.size()));
    rows_ = static_cast<int>((entries_.size() + columns - 1) / columns);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        const std::size_t row = k / columns;
        places_.push_back({widest * static_cast<double>(k % columns), line_ * static_cast<double>(row)});
    }
}

void Legend::draw(Canvas& canvas, Point corner) const {
    if (entries_.size() < 2) return;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        const Entry& entry = entries_[k];
        const double x = corner.x + places_[k].x, middle = corner.y + places_[k].y + 0.5 * line_;
        if (entry.bar) {
            canvas.rectangle({x + 0.25 * sample, middle - 2.5, 0.5 * sample, 5.0}, entry.colour);
        } else {
            canvas.line({{x, middle}, {x + sample, middle}}, entry.colour, curve_width, entry.dashed);
        }
        canvas.text({x + sample + 3.0, middle}, escaped(entry.label), Across::left, Down::middle, text_, ink);
    }
}

Legend legend_of(const Canvas& canvas, std::vector<Legend::Entry> entries, double width) {
    return {canvas, std::move(entries), width - beside_letter - 4.0};
}

Rect frame_below(const Canvas& canvas, const Rect& place, const Legend& legend, const Scale& x, const Scale& y) {
    const double left = Axes::room_left(canvas, y), right = Axes::room_right(canvas, x, place.width - left);
    const double top = place.y + room_above(canvas, legend);
    return {place.x + left, top, place.width - left - right, place.bottom() - Axes::room_below(canvas) - top};
}

void draw_legend_above(Canvas& canvas, const Rect& place, const Legend& legend, Axes& axes) {
    axes.frame = frame_below(canvas, place, legend, axes.x, axes.y);
    legend.draw(canvas, {place.x + beside_letter, place.y});
}

}  // namespace crackle::plot
