// SPDX-License-Identifier: GPL-3.0-or-later
// Draws specimens at a given moment: particles, platens, cracks, and on request the forces of faces.
// Tested by tests/tools/commands/plot_test.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/plot/axes.hpp"
#include "tools/plot/face_bands.hpp"
#include "tools/plot/moments.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {
namespace {

namespace fs = std::filesystem;

const Colour grain_edge = colour("#8d877b"), platen = colour("#4b5259"), joint_colour = colour("#2a7f62");

const Colour& colour_of(FaceLine::Kind kind) {
    switch (kind) {
        case FaceLine::Kind::tension:
            return tension_colour;
        case FaceLine::Kind::shear:
            return shear_colour;
        case FaceLine::Kind::joint:
            return joint_colour;
        case FaceLine::Kind::open_joint:
            break;
    }
    return ink;
}

constexpr double least_band = 0.02;       // smallest stress that is drawn, relative to ForceScales::high
constexpr double between_drawings = 6.0;  // pt
constexpr double key_height = 13.0;       // pt, height of the key, a line below the captions
constexpr double key_text = 0.85;         // text size of the key, relative to the font size
constexpr double caption_text = 0.9;      // text size of captions, relative to the font size

double caption_height(const Canvas& canvas, const std::vector<Moment>& moments) {
    std::size_t lines = 0;
    for (const Moment& moment : moments) lines = std::max(lines, moment.caption.size());
    return 5.0 + static_cast<double>(lines) * canvas.size_of("X", caption_text).height;
}

/// The largest length of the form 1, 2 or 5 times a power of ten that does not exceed `most`.
double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    return (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0) * power;
}

/// Width of the line of a crack, pt. @param size size of a cell, pt
double crack_width(double size) { return std::clamp(0.12 * size, 0.25, 0.9); }

/// Lengths in drawings of forces, the same for all moments.
struct ForceScales {
    double reach = 0.0;                   // half the width of a band per stress, m per N/m
    double high = 0.0;                    // N/m, stress exceeded at only a few ends of faces
    std::string unit = "N/m";             // unit of stresses
    double cell = 0.0;                    // m, size of a cell
    double widening = 0.0, widest = 0.0;  // width of a crack per opening, m per m; largest width, m
};

/// Median opening of the open cracks of a moment, m; infinite without open cracks.
double usual_opening(const Moment& moment) {
    std::vector<double> openings;
    for (const FaceLine& line : moment.faces)
        if (line.opening > 0.0) openings.push_back(line.opening);
    if (openings.empty()) return std::numeric_limits<double>::infinity();
    const auto middle = openings.begin() + static_cast<std::ptrdiff_t>(openings.size() / 2);
    std::ranges::nth_element(openings, middle);
    return *middle;
}

ForceScales scales_of(const std::vector<Moment>& moments) {
    constexpr double high_band = 0.18, widest_crack = 0.07;  // relative to the size of a cell
    std::vector<const FaceBand*> bands;
    // Openings grow a hundredfold after the peak. The moment with the narrowest cracks determines the scale, because
    // its cracks would otherwise be invisible.
    double opening = std::numeric_limits<double>::infinity();
    for (const Moment& moment : moments) {
        for (const FaceBand& band : moment.bands) bands.push_back(&band);
        if (moment.forces) opening = std::min(opening, usual_opening(moment));
    }
    ForceScales scales;
    const double size = scales.cell = moments.front().cell_size();
    scales.high = high_stress(bands);
    if (scales.high > 0.0) scales.reach = high_band * size / scales.high;
    if (!std::isfinite(opening)) return scales;
    scales.widest = widest_crack * size;
    scales.widening = scales.widest / round_length(2.0 * opening);
    return scales;
}

void draw_moment(Canvas& canvas, const Rect& place, const Moment& moment, const Extent& extent,
                 const ForceScales& scales) {
    const double scale = place.width / extent.width();
    const auto at = [&](Vec2 p) {
        return Point{place.x + scale * (p.x - extent.x1), place.bottom() - scale * (p.y - extent.y1)};
    };
    const auto on_sheet = [&](const std::vector<Vec2>& points) {
        std::vector<Point> all;
        all.reserve(points.size());
        for (const Vec2 p : points) all.push_back(at(p));
        return all;
    };
    // Edges are thinner for small particles; otherwise everything would look grey.
    const double size = scale * moment.cell_size();
    const double edge = std::clamp(0.035 * size, 0.04, 0.3), crack = crack_width(size);
    canvas.clip(place);
    for (std::size_t k = 0; k < moment.cells->size(); ++k) {
        const RecordedCell& cell = (*moment.cells)[k];
        if (!moment.shown[k]) continue;
        if (cell.radius > 0.0) {
            canvas.circle(at(moment.outlines[k].front()), scale * cell.radius, &moment.colour_of_cell(k), &grain_edge,
                          edge);
        } else if (cell.open) {
            canvas.line(on_sheet(moment.outlines[k]), platen, 1.2);
        } else {
            canvas.polygon(on_sheet(moment.outlines[k]), &moment.colour_of_cell(k), &grain_edge, edge);
        }
    }
    for (const FaceBand& band : moment.bands)
        if (band.largest() > least_band * scales.high)
            for (const BandPart& part : parts_of(band, scales.reach)) {
                const Colour& edge_colour = part.compression ? compressive_colour : tensile_colour;
                const Colour fill = band_fill(part.compression);
                canvas.polygon(on_sheet(part.corners), &fill, &edge_colour, 0.5 * edge);
            }
    for (const FaceLine& line : moment.faces)
        canvas.line({at(line.from), at(line.to)}, colour_of(line.kind),
                    crack + scale * std::clamp(scales.widening * line.opening, 0.0, scales.widest));
    const Colour rim = colour("#ffffff");
    for (const DrawnMark& mark : moment.marks) canvas.circle(at(mark.place), mark.radius, &mark.colour, &rim, 0.3);
    canvas.unclip();
}

struct Key {
    bool tension = false, shear = false, joint = false, open_joint = false;
    double magnify = 1.0;
    std::vector<std::string> minerals = {};
};

Key key_of(const std::vector<Moment>& moments, double magnify) {
    Key key;
    key.magnify = magnify;
    for (const Moment& moment : moments) {
        for (const FaceLine& line : moment.faces) {
            key.tension = key.tension || line.kind == FaceLine::Kind::tension;
            key.shear = key.shear || line.kind == FaceLine::Kind::shear;
            key.joint = key.joint || line.kind == FaceLine::Kind::joint;
            key.open_joint = key.open_joint || line.kind == FaceLine::Kind::open_joint;
        }
        if (key.minerals.empty()) key.minerals = moment.minerals;
    }
    return key;
}

/// A sample in the key, with its meaning.
struct KeyItem {
    enum class Sample : std::uint8_t { bar, line, patch, band, none };

    std::string text;
    Sample sample;
    Colour colour;
    double length, height = 0.0;  // pt; height of a band
};

/// Draws samples with their meanings in one line.
void draw_items(Canvas& canvas, const Rect& place, const std::vector<KeyItem>& items) {
    using Sample = KeyItem::Sample;
    const double middle = place.y + 0.5 * place.height;
    double lines = 0.0, texts = 0.0;  // pt
    for (const KeyItem& item : items) {
        lines += item.length;
        texts += (item.sample != Sample::none ? 3.0 : 0.0) + canvas.size_of(item.text, key_text).width;
    }
    double gap = 1.2 * canvas.style().font_size;
    texts += gap * (static_cast<double>(items.size()) - 1.0);
    // On a narrow sheet, everything is drawn with smaller letters.
    const double shrunk = std::min(1.0, (0.97 * place.width - lines) / texts), size = shrunk * key_text;
    gap *= shrunk;
    const double width = lines + shrunk * texts;
    double x = place.x + 0.5 * (place.width - width);
    for (const KeyItem& item : items) {
        const double end_x = x + item.length;
        if (item.sample == Sample::patch) {
            const double half = 0.5 * item.length;
            canvas.polygon({{x, middle - half}, {end_x, middle - half}, {end_x, middle + half}, {x, middle + half}},
                           &item.colour, &grain_edge, 0.3);
        } else if (item.sample == Sample::band) {
            canvas.rectangle({x, middle - 0.5 * item.height, item.length, item.height}, item.colour);
        } else if (item.sample != Sample::none) {
            const bool bar = item.sample == Sample::bar;
            canvas.line({{x, middle}, {end_x, middle}}, item.colour, bar ? 0.8 : 1.2);
            for (const double end : {x, end_x})
                if (bar) canvas.line({{end, middle - 2.0}, {end, middle + 2.0}}, ink, 0.8);
        }
        if (item.sample != Sample::none) x = end_x + 3.0 * shrunk;
        canvas.text({x, middle}, item.text, Across::left, Down::middle, size);
        x += canvas.size_of(item.text, size).width + gap;
    }
}

/// Draws scale bar, colours of minerals and cracks, and the magnification of displacements in one line.
void draw_key(Canvas& canvas, const Rect& place, const Key& key, double points_a_metre) {
    using Sample = KeyItem::Sample;
    const double length = round_length(std::min(60.0, 0.15 * place.width) / points_a_metre);
    const Unit unit = unit_for(length, "m");
    constexpr double patch = 6.0;  // pt
    std::vector<KeyItem> items{
        {fmt::format("{:.6g} {}", length / unit.factor, unit.name), Sample::bar, ink, length * points_a_metre}};
    for (std::size_t k = 0; k < key.minerals.size(); ++k)
        items.push_back({escaped(key.minerals[k]), Sample::patch, mineral_colour(k), patch});
    const auto add_line = [&](bool any, const char* text, const Colour& colour) {
        if (any) items.push_back({text, Sample::line, colour, 10.0});
    };
    add_line(key.tension, "broken in tension", tension_colour);
    add_line(key.shear, "in shear", shear_colour);
    add_line(key.joint, "joint", joint_colour);
    add_line(key.open_joint, "open joint", ink);
    if (key.magnify != 1.0)
        items.push_back({fmt::format("displacements ×{:.6g}", key.magnify), Sample::none, ink, 0.0});
    draw_items(canvas, place, items);
}

/// Draws the scales of the stresses of faces and of the openings of cracks in one line.
void draw_force_key(Canvas& canvas, const Rect& place, const ForceScales& scales, double points_a_metre) {
    constexpr double length = 10.0, highest = key_height - 3.0;  // pt
    using Sample = KeyItem::Sample;
    std::vector<KeyItem> items;
    if (scales.reach > 0.0) {
        const double width_of_one = 2.0 * scales.reach * points_a_metre;
        const double stress = round_length(std::min(scales.high, highest / width_of_one));
        const Unit unit = unit_for(stress, scales.unit);
        for (const bool compression : {true, false})
            items.push_back(
                {fmt::format("{} {:.6g} {}", compression ? "compression" : "tension", stress / unit.factor, unit.name),
                 Sample::band, band_fill(compression), length, stress * width_of_one});
    }
    if (scales.widening > 0.0) {
        const double opening = scales.widest / scales.widening;
        const Unit unit = unit_for(opening, "m");
        items.push_back({fmt::format("open ≥ {:.6g} {}", opening / unit.factor, unit.name), Sample::band, grain_edge,
                         length, crack_width(scales.cell * points_a_metre) + scales.widest * points_a_metre});
    }
    if (!items.empty()) draw_items(canvas, place, items);
}

/// Drawings side by side. All have the same scale and height; each has the width that it needs.
struct Row {
    std::vector<Moment> moments;
    double height = 0.0, widths = 0.0, widest = 0.0;  // m
    double gaps = 0.0;                                // pt

    explicit Row(std::vector<Moment> all) : moments(std::move(all)) {
        double y1 = std::numeric_limits<double>::infinity(), y2 = -y1;
        for (const Moment& moment : moments) {
            y1 = std::min(y1, moment.extent.y1);
            y2 = std::max(y2, moment.extent.y2);
            widths += moment.extent.width();
            widest = std::max(widest, moment.extent.width());
        }
        const double beyond = 0.02 * (y2 - y1);  // space for the outlines of the platens
        for (Moment& moment : moments) {
            moment.extent.y1 = y1 - beyond;
            moment.extent.y2 = y2 + beyond;
        }
        gaps = between_drawings * (static_cast<double>(moments.size()) - 1.0);
        height = y2 - y1 + 2.0 * beyond;
    }
    double scale_at(double panel_width) const {
        constexpr double highest = 300.0;  // pt; limited since a page-wide sheet may have further panels below
        // A single specimen need not fill the sheet.
        return std::min({(panel_width - gaps) / widths, 0.45 * panel_width / widest, highest / height});
    }
    /// Left edges of the drawings, relative to the left edge of the panel.
    std::vector<double> lefts_at(double panel_width) const {
        const double scale = scale_at(panel_width);
        std::vector<double> lefts;
        double x = 0.5 * (panel_width - scale * widths - gaps);
        for (const Moment& moment : moments) {
            lefts.push_back(x);
            x += scale * moment.extent.width() + between_drawings;
        }
        return lefts;
    }
};

}  // namespace

Panel drawings(const std::vector<DrawnMoment>& drawn, const std::vector<fs::path>& folders, const DrawingStyle& style) {
    std::vector<Moment> moments;
    for (std::size_t k = 0; k < drawn.size(); ++k) moments.push_back(moment_of(drawn[k], folders[k], style));
    const Row row(std::move(moments));
    ForceScales scales = scales_of(row.moments);
    if (drawn.front().recording->results.summary.about.material_units == StiffnessUnits::area) scales.unit = "Pa";
    const double keys_height = row.moments.front().forces ? 2.0 * key_height : key_height;
    Panel panel;
    panel.letter_above = true;
    panel.height = [row, keys_height](const Canvas& measure, double width) {
        return row.scale_at(width) * row.height + caption_height(measure, row.moments) + keys_height;
    };
    if (std::ranges::any_of(drawn, &DrawnMoment::lettered)) {
        panel.more_letters = [drawn, row](double width) {
            const std::vector<double> lefts = row.lefts_at(width);
            std::vector<double> letters;
            for (std::size_t k = 1; k < drawn.size(); ++k) {
                if (drawn[k].lettered) letters.push_back(lefts[k]);
            }
            return letters;
        };
    }
    panel.draw = [row, scales, keys_height, key = key_of(row.moments, style.magnify)](Canvas& canvas,
                                                                                      const Rect& place) {
        const double scale = row.scale_at(place.width), drawn_height = scale * row.height;
        const std::vector<double> lefts = row.lefts_at(place.width);
        for (std::size_t k = 0; k < row.moments.size(); ++k) {
            const Moment& moment = row.moments[k];
            const double width = scale * moment.extent.width(), x = place.x + lefts[k];
            draw_moment(canvas, {x, place.y, width, drawn_height}, moment, moment.extent, scales);
            canvas.text({x + 0.5 * width, place.y + drawn_height + 3.0},
                        fmt::format("{}", fmt::join(moment.caption, "\n")), Across::centre, Down::top, caption_text);
        }
        draw_key(canvas, {place.x, place.bottom() - keys_height, place.width, key_height}, key, scale);
        if (keys_height > key_height)
            draw_force_key(canvas, {place.x, place.bottom() - key_height, place.width, key_height}, scales, scale);
    };
    return panel;
}

}  // namespace crackle::plot
