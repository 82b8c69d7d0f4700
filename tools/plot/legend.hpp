// SPDX-License-Identifier: GPL-3.0-or-later
// Elements shared by diagrams: colours, line width of curves, unit of strain, means with intervals, and legends.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "tools/plot/axes.hpp"
#include "tools/plot/canvas.hpp"

namespace crackle::plot {

inline constexpr double strain_unit = 1e-3;
inline constexpr const char* strain_title = "axial strain, ‰";
inline constexpr const char* strain_unit_title = "‰";
inline constexpr double curve_width = 0.9;  // pt
/// Symbols for the crack initiation stress and the crack damage stress. <sub> is not used, because Pango would reset
/// its text size.
inline constexpr const char* crack_initiation_sign = "<i>σ</i><span size=\"75%\" rise=\"-2pt\">ci</span>";
inline constexpr const char* crack_damage_sign = "<i>σ</i><span size=\"75%\" rise=\"-2pt\">cd</span>";
inline constexpr double beside_letter = 20.0;  // pt, space to the left of a legend for the panel's letter

/// Colours of the report page (tools/viewer/src/colours/theme.ts), which can be distinguished with any type of colour
/// vision.
const Colour& series_colour(std::size_t number);

/// A colour mixed with white. @param share fraction of the colour
Colour tinted(const Colour& colour, double share);

/// A letter with a subscript, as Pango markup.
std::string indexed(const char* letter, const char* index);

/// A title with its unit, for example "peak stress, MPa".
std::string titled(const std::string& title, const std::string& unit);

/// Draws a mean, and its interval if the interval is finite. @param across whether the interval is along the x axis
void draw_mean(Canvas& canvas, Point mean, Point low, Point high, const Colour& colour, bool across);

/// The width from which the height of a diagram is computed, pt. It is limited, so that a diagram as wide as a page is
/// not half a page high.
inline double proportional(double width) { return std::min(width, 340.0); }

/// Legend of line samples with names, in equally wide columns that fit the width. Not drawn with a single entry.
class Legend {
  public:
    struct Entry {
        std::string label;
        Colour colour;
        bool dashed = false, bar = false;
    };
    Legend(const Canvas& canvas, std::vector<Entry> entries, double width);

    double height() const { return entries_.size() < 2 ? 0.0 : line_ * rows_ + 2.0; }
    void draw(Canvas& canvas, Point corner) const;
    /// Height of all rows after the first; the panel must be higher by this amount.
    double more_rows() const { return line_ * std::max(0, rows_ - 1); }

  private:
    static constexpr double sample = 14.0;  // pt
    std::vector<Entry> entries_;
    std::vector<Point> places_;
    double line_ = 0.0, text_ = 1.0;  // pt; `text_` is relative to the font size
    int rows_ = 0;
};

/// Legend that fits beside the letter of a panel of this width.
Legend legend_of(const Canvas& canvas, std::vector<Legend::Entry> entries, double width);

/// Height of the space for a legend above a panel: at least one line.
inline double room_above(const Canvas& canvas, const Legend& legend) {
    return std::max(legend.height(), 1.6 * canvas.style().font_size);
}

/// Frame of the axes: the part of a panel that remains below the legend and beside the numbers of the axes.
Rect frame_below(const Canvas& canvas, const Rect& place, const Legend& legend, const Scale& x, const Scale& y);

/// Draws a legend at the top of a panel, and sets the frame of the axes below it. The scales of the axes must be known.
void draw_legend_above(Canvas& canvas, const Rect& place, const Legend& legend, Axes& axes);

}  // namespace crackle::plot
