// SPDX-License-Identifier: GPL-3.0-or-later
// What diagrams have in common: their colours, the width of curves, the unit of strain, means with intervals, and a
// legend.
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
inline constexpr const char* strain_title = "axial strain, 10⁻³";
inline constexpr const char* strain_unit_title = "10⁻³";
inline constexpr double curve_width = 0.9;  // pt
/// Crack initiation and damage. Pango's own <sub> takes the default size for that of the text.
inline constexpr const char* crack_initiation_sign = "<i>σ</i><span size=\"75%\" rise=\"-2pt\">ci</span>";
inline constexpr const char* crack_damage_sign = "<i>σ</i><span size=\"75%\" rise=\"-2pt\">cd</span>";
inline constexpr double beside_letter = 20.0;  // pt, from the left of a panel, where its letter stands

/// As in the report (tools/viewer/src/colours/theme.ts): distinguishable with any colour vision.
const Colour& series_colour(std::size_t number);

/// A colour mixed with white.
Colour tinted(const Colour& colour, double share);

/// A letter with an index beneath, as Pango's markup.
std::string indexed(const char* letter, const char* index);

/// "peak stress, MPa"
std::string titled(const std::string& title, const std::string& unit);

/// A mean with its interval, where that is finite. @param across the interval lies along x
void draw_mean(Canvas& canvas, Point mean, Point low, Point high, const Colour& colour, bool across);

/// The width that a diagram's height is a share of: a page's width is no reason to be as high as half a page.
inline double proportional(double width) { return std::min(width, 340.0); }

/// Samples of line and name, in as many columns of equal width as fit between the sides; none of a single entry.
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
    /// Room of the rows beyond the first: a panel is so much higher.
    double more_rows() const { return line_ * std::max(0, rows_ - 1); }

  private:
    static constexpr double sample = 14.0;  // pt
    std::vector<Entry> entries_;
    std::vector<Point> places_;
    double line_ = 0.0, text_ = 1.0;  // text: of the font size
    int rows_ = 0;
};

/// Beside the letter of a panel of this width.
Legend legend_of(const Canvas& canvas, std::vector<Legend::Entry> entries, double width);

/// What a legend takes above a panel, at least a line.
inline double room_above(const Canvas& canvas, const Legend& legend) {
    return std::max(legend.height(), 1.6 * canvas.style().font_size);
}

/// What a legend above and the axes' numbers leave of a panel.
Rect frame_below(const Canvas& canvas, const Rect& place, const Legend& legend, const Scale& x, const Scale& y);

}  // namespace crackle::plot
