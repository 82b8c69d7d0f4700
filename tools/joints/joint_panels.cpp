// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/joints/joint_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"

namespace crackle::plot {
namespace {

constexpr double trace_width = 0.6;  // pt
constexpr double highest_share =
    1.4;  // largest height of a map, relative to its width; a slender specimen is drawn smaller
constexpr double rose_share = 0.55;  // height of a rose relative to its width
constexpr double radians = std::numbers::pi / 180.0;

std::vector<Legend::Entry> entries_of(const JointNetwork& network) {
    std::vector<Legend::Entry> entries;
    for (std::size_t k = 0; k < network.sources.size(); ++k)
        entries.push_back({network.sources[k].name, series_colour(k)});
    return entries;
}

/// Axes of a map of the box. Both have the same unit (m with an SI prefix) and the same spacing of ticks.
struct MapAxes {
    Unit unit;
    Scale x, y;

    MapAxes(const Domain& box, double width)
        : unit(unit_for(std::max({std::abs(box.x1), std::abs(box.x2), std::abs(box.y1), std::abs(box.y2)}), "m")) {
        x = {box.x1 / unit.factor, box.x2 / unit.factor, 0.0};
        y = {box.y1 / unit.factor, box.y2 / unit.factor, 0.0};
        const double longest = std::max(x.high - x.low, y.high - y.low);
        x.step = y.step = scale_for(0.0, longest, width < 300.0 ? 5 : 8).step;
    }
    double height(double width) const { return width * (y.high - y.low) / (x.high - x.low); }
};

Rect fitted_frame(const MapAxes& scales, Rect room) {
    const double shape = (scales.y.high - scales.y.low) / (scales.x.high - scales.x.low);
    const double width = std::min(room.width, room.height / shape);
    return {room.x, room.y, width, width * shape};
}

}  // namespace

Panel trace_map(const JointNetwork& network) {
    Panel panel;
    panel.height = [network](const Canvas& measure, double width) {
        const MapAxes scales(network.box, width);
        const double room = width - Axes::room_left(measure, scales.y);
        const double frame = room - Axes::room_right(measure, scales.x, room);
        return room_above(measure, legend_of(measure, entries_of(network), width)) +
               std::min(scales.height(frame), highest_share * width) + Axes::room_below(measure);
    };
    panel.draw = [network](Canvas& canvas, const Rect& place) {
        const Legend legend = legend_of(canvas, entries_of(network), place.width);
        const MapAxes scales(network.box, place.width);
        Axes axes;
        axes.x = scales.x;
        axes.y = scales.y;
        axes.frame = fitted_frame(scales, frame_below(canvas, place, legend, axes.x, axes.y));
        legend.draw(canvas, {place.x + beside_letter, place.y});
        canvas.clip(axes.frame);
        for (const JointTrace& trace : network.traces) {
            std::vector<Point> line;
            line.reserve(trace.points.size());
            for (const Vec2 p : trace.points)
                line.push_back(axes.at(p.x / scales.unit.factor, p.y / scales.unit.factor));
            canvas.line(line, series_colour(trace.source), trace_width);
        }
        canvas.unclip();
        const Rect& f = axes.frame;
        // The axes form the other two sides of the frame.
        canvas.line({{f.x, f.y}, {f.right(), f.y}, {f.right(), f.bottom()}}, ink, 0.5);
        axes.draw(canvas, titled("<i>x</i>", scales.unit.name), titled("<i>y</i>", scales.unit.name));
    };
    return panel;
}

Panel trace_rose(const JointNetwork& network, const JointReport& report) {
    Panel panel;
    panel.height = [](const Canvas& measure, double width) {
        return rose_share * proportional(width) + 2.0 * measure.style().font_size;
    };
    panel.draw = [network, report](Canvas& canvas, const Rect& place) {
        const double letters = 1.6 * canvas.style().font_size;
        const double radius = 0.5 * std::min(place.width, place.height) - letters;
        const Point centre{place.x + 0.5 * place.width, place.y + 0.5 * place.height};
        double largest = 0.0;
        for (const double weight : report.all.rose.weights) largest = std::max(largest, weight);
        if (!(largest > 0.0)) return;
        const auto at = [&](double share, double angle) {
            // The area of a petal is proportional to the square of its radius r.
            const double r = radius * std::sqrt(share / largest);
            return Point{centre.x + r * std::cos(angle), centre.y - r * std::sin(angle)};
        };
        constexpr int arc_points = 8;
        const auto petal = [&](double from, double to, double first, const Colour& colour) {
            std::vector<Point> corners;
            for (int k = 0; k <= arc_points; ++k)
                corners.push_back(at(to, first + radians * rose_bin_width * k / arc_points));
            for (int k = arc_points; k >= 0; --k)
                corners.push_back(at(from, first + radians * rose_bin_width * k / arc_points));
            const Colour white = plot::colour("#ffffff");
            canvas.polygon(corners, &colour, &white, 0.3);
        };
        const Colour faint = tinted(ink, 0.45);
        canvas.circle(centre, radius, nullptr, &faint, 0.4);
        for (const double turn : {0.0, 180.0}) {
            for (std::size_t bin = 0; bin < rose_bins; ++bin) {
                const double first =
                    radians * (turn + report.all.rose.begins + rose_bin_width * static_cast<double>(bin));
                double below = 0.0;
                for (std::size_t k = 0; k < report.sources.size(); ++k) {
                    const double weight = report.sources[k].rose.weights[bin];
                    if (weight > 0.0) petal(below, below + weight, first, series_colour(k));
                    below += weight;
                }
            }
        }
        constexpr double beside = 3.0;  // pt
        canvas.text({centre.x + radius + beside, centre.y}, "0°", Across::left, Down::middle);
        canvas.text({centre.x, centre.y - radius - beside}, "90°", Across::centre, Down::bottom);
        canvas.text({centre.x - radius, centre.y + radius},
                    fmt::format("outer circle: {:.0f} %", 100.0 * largest / report.all.rose.weight), Across::left,
                    Down::top, 0.85);
    };
    return panel;
}

}  // namespace crackle::plot
