// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet for drawing figures for print as SVG, PDF or PNG: drawing with Cairo, text with Pango. Fonts are embedded
// (PDF) or drawn as outlines (SVG). Lengths are in points (1/72 inch), from the upper left corner, y downwards.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <vector>

#include "solver/base/names.hpp"

namespace crackle::plot {

inline constexpr double points_of_mm = 72.0 / 25.4;

struct Colour {
    double red = 0.0, green = 0.0, blue = 0.0;  // from 0 to 1
};
/// Parses a colour of the form "#rrggbb".
Colour colour(const char* hex);

// Colours of the report page (tools/viewer/src/colours/theme.ts), which can be distinguished with any type of colour
// vision.
inline const Colour ink = colour("#1d2125"), tension_colour = colour("#0072b2"), shear_colour = colour("#d55e00");

struct Point {
    double x = 0.0, y = 0.0;
};

struct Rect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
};

enum class Format { svg, pdf, png };
constexpr auto list_names(Format) { return in_order("svg", "pdf", "png"); }

struct SheetStyle {
    std::string font = "DejaVu Sans";
    double font_size = 8.0;  ///< pt
    double dpi = 300.0;      ///< dots per inch, for PNG
};

enum class Across { left, centre, right };
enum class Down { top, middle, bottom };

struct TextSize {
    double width = 0.0, height = 0.0;
};

class Canvas {
  public:
    /// @throws std::runtime_error if Cairo cannot create the sheet
    Canvas(double width, double height, Format format, const SheetStyle& style);
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;
    ~Canvas();

    const SheetStyle& style() const { return style_; }

    void line(const std::vector<Point>& points, const Colour& colour, double width, bool dashed = false);
    void polygon(const std::vector<Point>& corners, const Colour* fill, const Colour* edge, double edge_width);
    void circle(Point centre, double radius, const Colour* fill, const Colour* edge, double edge_width);
    void rectangle(const Rect& rect, const Colour& fill);

    /// @param markup in Pango's format: <sup>, <i>, <b>
    TextSize size_of(const std::string& markup, double scale = 1.0) const;
    /// @param at anchor point of the text @param across, down which point of the text lies at the anchor @param scale
    /// relative to the font size
    void text(Point at, const std::string& markup, Across across = Across::left, Down down = Down::top,
              double scale = 1.0, const Colour& colour = {}, bool upwards = false);

    /// Restricts drawing to the rectangle until unclip() is called.
    void clip(const Rect& rect);
    void unclip();

    /// Returns the finished file; nothing can be drawn afterwards.
    std::string finish();

  private:
    void set(const Colour& colour);
    void stroke(const Colour& colour, double width);

    SheetStyle style_;
    Format format_;
    std::string bytes_;  // output written by Cairo
    cairo_surface_t* surface_ = nullptr;
    cairo_t* cairo_ = nullptr;
};

/// Text with special characters escaped for Pango markup.
std::string escaped(const std::string& text);

}  // namespace crackle::plot
