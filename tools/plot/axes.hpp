// SPDX-License-Identifier: GPL-3.0-or-later
// Linear axes: ticks at 1, 2 or 5 times a power of ten, SI prefixes, and the frame in which curves are drawn.
// Tested by tests/tools/plot/axes_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace crackle::plot {

/// A range of values with ticks.
struct Scale {
    double low = 0.0, high = 1.0;
    double step = 0.2;  ///< distance between ticks

    std::vector<double> ticks() const;
    /// Label of a tick, with the number of decimals that the step needs.
    std::string label(double tick) const;
};

/// Smallest and largest value of one or more lists.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(const std::vector<double>& values) {
        for (const double value : values) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    /// Largest magnitude.
    double size() const { return std::max(std::abs(low), std::abs(high)); }
};

/// A scale from 0 (or below) to slightly above the largest value, with at least one tick in addition to the one at 0.
/// @param most_ticks largest number of intervals, unless this would leave only one tick
Scale scale_for(double smallest, double largest, int most_ticks);
/// A scale that includes all values. It also includes 0, unless the magnitude of every value exceeds half of the
/// largest magnitude.
Scale scale_around(double smallest, double largest, int most_ticks);

/// A unit with the SI prefix for which the largest value is between 1 and 1000, for example {1e3, "kN/m"}. In "N/m or
/// Pa" both units get the prefix.
struct Unit {
    double factor = 1.0;
    std::string name;
};
Unit unit_for(double largest, const std::string& unit);
/// A unit without SI prefix; if the numbers would be long, with a power of a thousand: {1e6, "10⁶ dyn"}.
Unit unit_with_power(double largest, const std::string& unit);

struct Axes {
    Rect frame;  ///< area for curves, pt
    Scale x, y;
    double text = 1.0;  ///< text size relative to the font size

    Point at(double value_x, double value_y) const;
    /// Draws frame, ticks, numbers and titles. The x axis has numbers only if x_title is not empty.
    void draw(Canvas& canvas, const std::string& x_title, const std::string& y_title) const;
    void draw_right(Canvas& canvas, const Scale& scale, const std::string& title) const;
    /// Space needed for numbers and a title beside the frame, pt.
    static double room_left(const Canvas& canvas, const Scale& scale, double text = 1.0);
    static double room_below(const Canvas& canvas, double text = 1.0);
    /// Space needed to the right of the frame for the number at the last tick, pt.
    /// @param room distance from the left edge of the frame to the right edge of the panel, pt
    static double room_right(const Canvas& canvas, const Scale& x, double room, double text = 1.0);
};

}  // namespace crackle::plot
