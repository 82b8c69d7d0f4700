// SPDX-License-Identifier: GPL-3.0-or-later
// Linear axes: ticks at 1, 2 or 5 times a power of ten, SI prefixes, and the frame that curves are drawn into.
// Tested by tests/tools/plot/axes_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace crackle::plot {

/// A range with ticks on it.
struct Scale {
    double low = 0.0, high = 1.0;
    double step = 0.2;  ///< between ticks

    std::vector<double> ticks() const;
    /// As many decimals as the step has.
    std::string label(double tick) const;
};

/// From 0 (or below) to the largest value and a little more, with a tick beside that at 0.
/// @param most_ticks  at most so many intervals, where that leaves a second tick
Scale scale_for(double smallest, double largest, int most_ticks);
/// The same around 0 and all values; without 0 where they lie farther from it than half of their size.
Scale scale_around(double smallest, double largest, int most_ticks);

/// A unit with the prefix that puts the largest value between 1 and 1000: {1e3, "kN/m"}; of "N/m or Pa" each has it.
struct Unit {
    double factor = 1.0;
    std::string name;
};
Unit unit_for(double largest, const std::string& unit);
/// Of a unit that takes no prefix, a power of a thousand where the numbers would be long: {1e6, "10⁶ dyn"}.
Unit unit_with_power(double largest, const std::string& unit);

struct Axes {
    Rect frame;  ///< inside of which curves lie, pt
    Scale x, y;
    double text = 1.0;  ///< of the font size

    Point at(double value_x, double value_y) const;
    /// Frame, ticks, numbers and titles; tick labels of x only where asked.
    void draw(Canvas& canvas, const std::string& x_title, const std::string& y_title) const;
    void draw_right(Canvas& canvas, const Scale& scale, const std::string& title) const;
    /// Room that numbers and a title need beside the frame, pt.
    static double room_left(const Canvas& canvas, const Scale& scale, double text = 1.0);
    static double room_below(const Canvas& canvas, double text = 1.0);
    /// Room that the number at the last tick needs to the right of the frame, pt.
    /// @param room from the frame's left end to the panel's right one
    static double room_right(const Canvas& canvas, const Scale& x, double room, double text = 1.0);
};

}  // namespace crackle::plot
