// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace crackle::plot {
namespace {

constexpr double tick_length = 2.5, frame_width = 0.6, label_gap = 2.0;  // pt

std::string with_minus(std::string number) {
    if (number.starts_with('-')) number.replace(0, 1, "−");
    return number;
}

double widest_label(const Canvas& canvas, const Scale& scale, double text) {
    double widest = 0.0;
    for (const double tick : scale.ticks()) widest = std::max(widest, canvas.size_of(scale.label(tick), text).width);
    return widest;
}

/// Text size, at most `text`, at which the title of an axis is not longer than the axis.
double fitting(const Canvas& canvas, const std::string& title, double length, double text) {
    return title.empty() ? text : std::min(text, text * length / canvas.size_of(title, text).width);
}

}  // namespace

std::vector<double> Scale::ticks() const {
    std::vector<double> all;
    const auto first = static_cast<long>(std::ceil(low / step - 1e-9)),
               last = static_cast<long>(std::floor(high / step + 1e-9));
    for (long k = first; k <= last; ++k) all.push_back(static_cast<double>(k) * step);
    return all;
}

std::string Scale::label(double tick) const {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    return with_minus(fmt::format("{:.{}f}", std::abs(tick) < 1e-9 * step ? 0.0 : tick, decimals));
}

namespace {

/// A scale with ticks, and space below the lowest value unless the lower end is fixed.
Scale ticked(double low, double high, int most_ticks, bool room_below) {
    const double raw = (high - low) / most_ticks;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    constexpr std::array<double, 6> steps{0.2, 0.5, 1.0, 2.0, 5.0, 10.0};
    const auto* step =
        std::find_if(steps.begin() + 2, steps.end() - 1, [&](double s) { return s * power >= raw * (1.0 - 1e-9); });
    // Leave space between the uppermost curve and the frame.
    Scale scale{room_below ? low - 0.04 * (high - low) : low, high + 0.06 * (high - low), *step * power};
    while (scale.ticks().size() < 2 && step != steps.begin()) scale.step = *--step * power;
    return scale;
}

}  // namespace

Scale scale_for(double smallest, double largest, int most_ticks) {
    const double low = std::min(0.0, smallest);
    return ticked(low, largest > low ? largest : low + 1.0, most_ticks, low < 0.0);
}

Scale scale_around(double smallest, double largest, int most_ticks) {
    constexpr double far = 0.5;  // the axis omits 0 if all values exceed this fraction of the largest (by magnitude)
    if (largest > smallest && (smallest > far * largest || largest < far * smallest))
        return ticked(smallest, largest, most_ticks, true);
    return scale_for(smallest, std::max(0.0, largest), most_ticks);
}

namespace {

std::string superscript(int number) {
    constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(number))) text += digits.at(static_cast<std::size_t>(digit - '0'));
    return text;
}

/// A unit such as "N/m or Pa" with the prefix added to each part.
std::string prefixed(const std::string& unit, const std::string& prefix) {
    const std::string between = " or ";
    const std::size_t at = unit.find(between);
    if (at == std::string::npos) return prefix + unit;
    return prefix + unit.substr(0, at) + between + prefixed(unit.substr(at + between.size()), prefix);
}

}  // namespace

Unit unit_for(double largest, const std::string& unit) {
    constexpr std::array<std::pair<double, const char*>, 8> prefixes{
        {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}}};
    for (const auto& [factor, prefix] : prefixes) {
        if (std::abs(largest) >= 0.9995 * factor) return {factor, prefixed(unit, prefix)};
    }
    return {1.0, unit};
}

Unit unit_with_power(double largest, const std::string& unit) {
    constexpr double longest = 1e4, shortest = 1e-2;
    const double size = std::abs(largest);
    if (size == 0.0 || (size >= shortest && size < longest)) return {1.0, unit};
    const int power = 3 * static_cast<int>(std::floor(std::log10(size) / 3.0));
    return {std::pow(10.0, power), fmt::format("10{}{}{}", superscript(power), unit.empty() ? "" : " ", unit)};
}

Point Axes::at(double value_x, double value_y) const {
    return {frame.x + (value_x - x.low) / (x.high - x.low) * frame.width,
            frame.bottom() - (value_y - y.low) / (y.high - y.low) * frame.height};
}

double Axes::room_left(const Canvas& canvas, const Scale& scale, double text) {
    return widest_label(canvas, scale, text) + canvas.size_of("0", text).height + tick_length + 2.0 * label_gap;
}

double Axes::room_below(const Canvas& canvas, double text) {
    return 2.0 * canvas.size_of("0", text).height + tick_length + label_gap;
}

double Axes::room_right(const Canvas& canvas, const Scale& x, double room, double text) {
    constexpr double least = 4.0;  // pt
    const std::vector<double> ticks = x.ticks();
    if (ticks.empty()) return least;
    const double beyond_tick = 0.5 * canvas.size_of(x.label(ticks.back()), text).width;
    const double rest =
        (x.high - ticks.back()) / (x.high - x.low);  // part of the frame's width to the right of the last tick
    return std::max(least, (beyond_tick - rest * room) / (1.0 - rest));
}

void Axes::draw(Canvas& canvas, const std::string& x_title, const std::string& y_title) const {
    const double height = canvas.size_of("0", text).height;
    for (const double tick : y.ticks()) {
        const Point mark = at(x.low, tick);
        canvas.line({mark, {mark.x - tick_length, mark.y}}, ink, frame_width);
        canvas.text({mark.x - tick_length - label_gap, mark.y}, y.label(tick), Across::right, Down::middle, text, ink);
    }
    const double title_x = frame.x - tick_length - 2.0 * label_gap - widest_label(canvas, y, text);
    canvas.text({title_x, frame.y + 0.5 * frame.height}, y_title, Across::centre, Down::bottom,
                fitting(canvas, y_title, frame.height, text), ink, true);
    for (const double tick : x.ticks()) {
        const Point mark = at(tick, y.low);
        canvas.line({mark, {mark.x, mark.y + tick_length}}, ink, frame_width);
        if (!x_title.empty())
            canvas.text({mark.x, mark.y + tick_length + 0.5 * label_gap}, x.label(tick), Across::centre, Down::top,
                        text, ink);
    }
    if (!x_title.empty()) {
        canvas.text({frame.x + 0.5 * frame.width, frame.bottom() + tick_length + label_gap + height}, x_title,
                    Across::centre, Down::top, fitting(canvas, x_title, frame.width, text), ink);
    }
    canvas.line({{frame.x, frame.y}, {frame.x, frame.bottom()}, {frame.right(), frame.bottom()}}, ink, frame_width);
}

void Axes::draw_right(Canvas& canvas, const Scale& scale, const std::string& title) const {
    const Colour grey = colour("#5b636b");
    Axes other = *this;
    other.y = scale;
    for (const double tick : scale.ticks()) {
        const Point mark = other.at(x.high, tick);
        canvas.line({mark, {mark.x + tick_length, mark.y}}, grey, frame_width);
        canvas.text({mark.x + tick_length + label_gap, mark.y}, scale.label(tick), Across::left, Down::middle, text,
                    grey);
    }
    canvas.line({{frame.right(), frame.y}, {frame.right(), frame.bottom()}}, grey, frame_width);
    const double title_x = frame.right() + tick_length + 2.0 * label_gap + widest_label(canvas, scale, text);
    canvas.text({title_x, frame.y + 0.5 * frame.height}, title, Across::centre, Down::top,
                fitting(canvas, title, frame.height, text), grey, true);
}

}  // namespace crackle::plot
