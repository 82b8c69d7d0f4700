// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace crackle::plot {
namespace {

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

struct Unref {
    void operator()(void* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

Layout layout_of(cairo_t* cairo, const SheetStyle& style, const std::string& markup, double scale) {
    Layout layout(pango_cairo_create_layout(cairo));
    // Hinting is off and the resolution is 72 dots per inch, so that text has the same size in all formats.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    PangoContext* context = pango_layout_get_context(layout.get());
    pango_cairo_context_set_font_options(context, options);
    pango_cairo_context_set_resolution(context, 72.0);
    cairo_font_options_destroy(options);
    pango_layout_context_changed(layout.get());
    PangoFontDescription* font = pango_font_description_from_string(style.font.c_str());
    pango_font_description_set_size(font, static_cast<int>(std::lround(scale * style.font_size * PANGO_SCALE)));
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_markup(layout.get(), markup.c_str(), -1);
    pango_layout_set_alignment(layout.get(), PANGO_ALIGN_CENTER);
    return layout;
}

TextSize size_of_layout(PangoLayout* layout) {
    PangoRectangle logical;
    pango_layout_get_extents(layout, nullptr, &logical);
    return {static_cast<double>(logical.width) / PANGO_SCALE, static_cast<double>(logical.height) / PANGO_SCALE};
}

}  // namespace

Colour colour(const char* hex) {
    const long all = std::strtol(hex + 1, nullptr, 16);
    const auto part = [all](int shift) { return static_cast<double>((all >> shift) & 0xff) / 255.0; };
    return {part(16), part(8), part(0)};
}

std::string escaped(const std::string& text) {
    char* markup = g_markup_escape_text(text.c_str(), -1);
    std::string out(markup);
    g_free(markup);
    return out;
}

Canvas::Canvas(double width, double height, Format format, const SheetStyle& style) : style_(style), format_(format) {
    switch (format) {
        case Format::svg:
            surface_ = cairo_svg_surface_create_for_stream(append, &bytes_, width, height);
            break;
        case Format::pdf:
            surface_ = cairo_pdf_surface_create_for_stream(append, &bytes_, width, height);
            // The creation date is left empty, so that the same figure gives identical bytes.
            cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE, "");
            break;
        case Format::png:
            surface_ =
                cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width / 72.0 * style.dpi)),
                                           static_cast<int>(std::lround(height / 72.0 * style.dpi)));
            break;
    }
    cairo_ = cairo_create(surface_);
    if (cairo_status(cairo_) != CAIRO_STATUS_SUCCESS) {
        const std::string why = cairo_status_to_string(cairo_status(cairo_));
        cairo_destroy(cairo_);
        cairo_surface_destroy(surface_);
        throw std::runtime_error(
            fmt::format("Cairo cannot make a sheet of {:.0f} x {:.0f} pt: {}", width, height, why));
    }
    if (format == Format::png) {
        // cairo_paint() makes every pixel white. Filling a rectangle of the sheet's size would cover the last row and
        // column of pixels only partly, which would be visible as a grey line.
        set(colour("#ffffff"));
        cairo_paint(cairo_);
        cairo_scale(cairo_, style.dpi / 72.0, style.dpi / 72.0);
    }
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);
}

Canvas::~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
}

void Canvas::set(const Colour& colour) { cairo_set_source_rgb(cairo_, colour.red, colour.green, colour.blue); }

void Canvas::stroke(const Colour& colour, double width) {
    set(colour);
    cairo_set_line_width(cairo_, width);
    cairo_stroke(cairo_);
}

void Canvas::line(const std::vector<Point>& points, const Colour& colour, double width, bool dashed) {
    for (const Point& point : points) cairo_line_to(cairo_, point.x, point.y);
    constexpr double dash[]{4.0, 2.0};
    if (dashed) cairo_set_dash(cairo_, dash, 2, 0.0);
    stroke(colour, width);
    cairo_set_dash(cairo_, nullptr, 0, 0.0);
}

void Canvas::polygon(const std::vector<Point>& corners, const Colour* fill, const Colour* edge, double edge_width) {
    for (const Point& corner : corners) cairo_line_to(cairo_, corner.x, corner.y);
    cairo_close_path(cairo_);
    if (fill != nullptr) {
        set(*fill);
        edge != nullptr ? cairo_fill_preserve(cairo_) : cairo_fill(cairo_);
    }
    if (edge != nullptr) stroke(*edge, edge_width);
    cairo_new_path(cairo_);
}

void Canvas::circle(Point centre, double radius, const Colour* fill, const Colour* edge, double edge_width) {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
    cairo_close_path(cairo_);
    if (fill != nullptr) {
        set(*fill);
        edge != nullptr ? cairo_fill_preserve(cairo_) : cairo_fill(cairo_);
    }
    if (edge != nullptr) stroke(*edge, edge_width);
    cairo_new_path(cairo_);
}

void Canvas::rectangle(const Rect& rect, const Colour& fill) {
    set(fill);
    cairo_rectangle(cairo_, rect.x, rect.y, rect.width, rect.height);
    cairo_fill(cairo_);
}

TextSize Canvas::size_of(const std::string& markup, double scale) const {
    return size_of_layout(layout_of(cairo_, style_, markup, scale).get());
}

void Canvas::text(Point at, const std::string& markup, Across across, Down down, double scale, const Colour& colour,
                  bool upwards) {
    const Layout layout = layout_of(cairo_, style_, markup, scale);
    const TextSize size = size_of_layout(layout.get());
    const double x = across == Across::left ? 0.0 : across == Across::centre ? -0.5 * size.width : -size.width;
    const double y = down == Down::top ? 0.0 : down == Down::middle ? -0.5 * size.height : -size.height;
    cairo_save(cairo_);
    cairo_translate(cairo_, at.x, at.y);
    if (upwards) cairo_rotate(cairo_, -0.5 * std::numbers::pi);
    cairo_move_to(cairo_, x, y);
    set(colour);
    pango_cairo_show_layout(cairo_, layout.get());
    cairo_restore(cairo_);
    cairo_new_path(cairo_);
}

void Canvas::clip(const Rect& rect) {
    cairo_save(cairo_);
    cairo_rectangle(cairo_, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(cairo_);
}

void Canvas::unclip() { cairo_restore(cairo_); }

std::string Canvas::finish() {
    if (format_ == Format::png) cairo_surface_write_to_png_stream(surface_, append, &bytes_);
    cairo_surface_finish(surface_);
    if (cairo_surface_status(surface_) != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error(fmt::format("Cairo could not finish the figure: {}",
                                             cairo_status_to_string(cairo_surface_status(surface_))));
    }
    return std::move(bytes_);
}

}  // namespace crackle::plot
