// SPDX-License-Identifier: GPL-3.0-or-later
// Specimens as they lie at a moment: particles, platens, cracks.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "specimens/observers/read_frames.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {
namespace {

namespace fs = std::filesystem;

const Colour grain = colour("#e3e0d9"), grain_edge = colour("#8d877b"), platen = colour("#4b5259");

struct Extent {
    double x1 = std::numeric_limits<double>::infinity(), x2 = -x1, y1 = x1, y2 = -x1;
    void include(Vec2 place, double reach) {
        x1 = std::min(x1, place.x - reach);
        x2 = std::max(x2, place.x + reach);
        y1 = std::min(y1, place.y - reach);
        y2 = std::max(y2, place.y + reach);
    }
    void include_height(double y) {
        y1 = std::min(y1, y);
        y2 = std::max(y2, y);
    }
    double width() const { return x2 - x1; }
    double height() const { return y2 - y1; }
};

struct CrackLine {
    Vec2 from, to;
    bool shear = false;
};

/// The cracks of a frame, where its test wrote them.
std::vector<CrackLine> cracks_of(const fs::path& folder, const FrameHead& head) {
    fs::path file = folder / head.file;
    std::string name = file.filename().string();
    const std::string from = "particles_";
    if (!name.starts_with(from)) return {};
    file.replace_filename("cracks_" + name.substr(from.size()));
    if (!fs::exists(file)) return {};
    const PolyData data = read_polydata(file);
    const auto mode = data.cell_data.find("mode");
    std::vector<CrackLine> cracks;
    for (std::size_t k = 0; k < data.cells.size(); ++k) {
        const std::vector<std::size_t>& ends = data.cells[k].points;
        const bool shear = mode != data.cell_data.end() && mode->second.at(k) != 0.0;
        cracks.push_back({data.points.at(ends.front()), data.points.at(ends.back()), shear});
    }
    return cracks;
}

/// A moment ready to be drawn.
struct Moment {
    std::vector<std::vector<Vec2>> outlines;  // of cells; one point of circles
    const std::vector<RecordedCell>* cells = nullptr;
    std::vector<CrackLine> cracks;
    std::string caption;
    Extent extent;
};

/// Makes room for what displacements larger than true carry away: for fragments of a twentieth of all cells or more.
void include_magnified(Moment& moment, const RecordedFrame& frame, double magnify) {
    if (magnify <= 1.0) return;
    const std::vector<RecordedCell>& cells = *moment.cells;
    std::map<double, std::size_t> cells_of;
    const auto fragment = [&](std::size_t k) { return frame.fragment.empty() ? 0.0 : frame.fragment[k]; };
    for (std::size_t k = 0; k < cells.size(); ++k) ++cells_of[fragment(k)];
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (cells[k].platen || 20 * cells_of[fragment(k)] < cells.size()) continue;
        for (const Vec2 place : moment.outlines[k]) moment.extent.include(place, cells[k].radius);
    }
}

Moment prepared(const DrawnMoment& drawn, const fs::path& folder, const DrawingStyle& style) {
    const Recording& recording = *drawn.recording;
    const RecordedFrame frame = recording.frame(drawn.frame);
    Moment moment;
    moment.cells = &recording.cells;
    moment.caption = drawn.caption;
    for (std::size_t k = 0; k < recording.cells.size(); ++k) {
        const RecordedCell& cell = recording.cells[k];
        const Vec2 centre = cell.centre + style.magnify * Vec2{frame.ux[k], frame.uy[k]};
        const double cosine = std::cos(frame.angle[k]), sine = std::sin(frame.angle[k]);
        std::vector<Vec2> outline;
        if (cell.radius > 0.0) outline.push_back(centre);
        for (const Vec2 corner : cell.outline) {
            const Vec2 arm = corner - cell.centre;
            outline.push_back(centre + Vec2{cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y});
        }
        // What has flown off would make the specimen small: the sheet shows it as it was, with its surroundings.
        if (cell.platen) {
            moment.extent.include_height(outline.front().y);
        } else {
            moment.extent.include(cell.centre, cell.radius);
        }
        moment.outlines.push_back(std::move(outline));
    }
    include_magnified(moment, frame, style.magnify);
    // Cracks lie where the solver says: only true displacements have them.
    if (style.magnify == 1.0) moment.cracks = cracks_of(folder, recording.frames[drawn.frame]);
    return moment;
}

/// Room around a specimen for what bulges and moves out, of its width.
constexpr double surroundings = 0.18;
constexpr double between_drawings = 6.0;  // pt
constexpr double key_height = 13.0;       // pt, of the line under the captions
constexpr double key_text = 0.85;         // of the font size

Extent common_extent(const std::vector<Moment>& moments) {
    Extent all;
    for (const Moment& moment : moments) {
        all.include({moment.extent.x1, moment.extent.y1}, 0.0);
        all.include({moment.extent.x2, moment.extent.y2}, 0.0);
    }
    const double room = surroundings * all.width();
    all.x1 -= room;
    all.x2 += room;
    all.y1 -= 0.25 * room;
    all.y2 += 0.25 * room;
    return all;
}

void draw_moment(Canvas& canvas, const Rect& place, const Moment& moment, const Extent& extent) {
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
    // Many small particles would be black with edges of a usual width.
    const double edge = std::min(0.3, 6.0 / std::sqrt(static_cast<double>(moment.cells->size()) + 1.0));
    canvas.clip(place);
    for (std::size_t k = 0; k < moment.cells->size(); ++k) {
        const RecordedCell& cell = (*moment.cells)[k];
        if (cell.radius > 0.0) {
            canvas.circle(at(moment.outlines[k].front()), scale * cell.radius, &grain, &grain_edge, edge);
        } else if (cell.open) {
            canvas.line(on_sheet(moment.outlines[k]), platen, 1.2);
        } else {
            canvas.polygon(on_sheet(moment.outlines[k]), &grain, &grain_edge, edge);
        }
    }
    for (const CrackLine& crack : moment.cracks)
        canvas.line({at(crack.from), at(crack.to)}, crack.shear ? shear_colour : tension_colour, 2.0 * edge + 0.3);
    canvas.unclip();
}

/// 1, 2 or 5 times a power of ten, at most the length.
double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    return (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0) * power;
}

struct Key {
    bool tension = false, shear = false;
    double magnify = 1.0;
};

/// Scale bar, what the cracks' colours mean and by how much displacements are magnified, in one line.
void draw_key(Canvas& canvas, const Rect& place, const Key& key, double points_a_metre) {
    const double middle = place.y + 0.5 * place.height, gap = 1.2 * canvas.style().font_size;
    const double length = round_length(60.0 / points_a_metre), bar = length * points_a_metre;
    const Unit unit = unit_for(length, "m");
    struct Item {
        std::string text;
        const Colour* line;  // nullptr: text alone
        double length;       // pt
    };
    std::vector<Item> items{{fmt::format("{:.6g} {}", length / unit.factor, unit.name), &ink, bar}};
    if (key.tension) items.push_back({"broken in tension", &tension_colour, 10.0});
    if (key.shear) items.push_back({"in shear", &shear_colour, 10.0});
    if (key.magnify != 1.0) items.push_back({fmt::format("displacements ×{:.6g}", key.magnify), nullptr, 0.0});
    double width = -gap;
    for (const Item& item : items)
        width += item.length + (item.line != nullptr ? 3.0 : 0.0) + canvas.size_of(item.text, key_text).width + gap;
    double x = place.x + 0.5 * (place.width - width);
    for (const Item& item : items) {
        if (item.line != nullptr) {
            canvas.line({{x, middle}, {x + item.length, middle}}, *item.line, item.line == &ink ? 0.8 : 1.2);
            if (item.line == &ink) {
                for (const double end : {x, x + item.length})
                    canvas.line({{end, middle - 2.0}, {end, middle + 2.0}}, ink, 0.8);
            }
            x += item.length + 3.0;
        }
        canvas.text({x, middle}, item.text, Across::left, Down::middle, key_text);
        x += canvas.size_of(item.text, key_text).width + gap;
    }
}

}  // namespace

Panel drawings(const std::vector<DrawnMoment>& drawn, const std::vector<fs::path>& folders, const DrawingStyle& style) {
    std::vector<Moment> moments;
    for (std::size_t k = 0; k < drawn.size(); ++k) moments.push_back(prepared(drawn[k], folders[k], style));
    const Extent extent = common_extent(moments);
    const auto each = [count = moments.size()](double width) {
        const auto number = static_cast<double>(count);
        // A single specimen need not fill the sheet.
        return std::min((width - between_drawings * (number - 1.0)) / number, 0.45 * width);
    };
    const bool two_lines = std::any_of(drawn.begin(), drawn.end(), [](const DrawnMoment& moment) {
        return moment.caption.find('\n') != std::string::npos;
    });
    const double caption = two_lines ? 25.0 : 14.0;  // pt
    Key key;
    key.magnify = style.magnify;
    for (const Moment& moment : moments) {
        for (const CrackLine& crack : moment.cracks) (crack.shear ? key.shear : key.tension) = true;
    }
    Panel panel;
    panel.letter_above = true;
    panel.height = [extent, each, caption](double width) {
        return each(width) * extent.height() / extent.width() + caption + key_height;
    };
    panel.draw = [moments, extent, each, caption, key](Canvas& canvas, const Rect& place) {
        const double width = each(place.width);
        const auto count = static_cast<double>(moments.size());
        double x = place.x + 0.5 * (place.width - count * width - between_drawings * (count - 1.0));
        for (const Moment& moment : moments) {
            draw_moment(canvas, {x, place.y, width, place.height - caption - key_height}, moment, extent);
            canvas.text({x + 0.5 * width, place.bottom() - key_height - caption + 3.0}, moment.caption, Across::centre,
                        Down::top);
            x += width + between_drawings;
        }
        draw_key(canvas, {place.x, place.bottom() - key_height, place.width, key_height}, key, width / extent.width());
    };
    return panel;
}

}  // namespace crackle::plot
