// SPDX-License-Identifier: GPL-3.0-or-later
// Specimens as they lie at a moment: particles, platens, cracks.

#include <algorithm>
#include <cmath>
#include <limits>

#include "specimens/observers/read_frames.hpp"
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
    // Cracks lie where the solver says: only true displacements have them.
    if (style.magnify == 1.0) moment.cracks = cracks_of(folder, recording.frames[drawn.frame]);
    return moment;
}

/// Room around a specimen for what bulges and moves out, of its width.
constexpr double surroundings = 0.18;
constexpr double between_drawings = 6.0;  // pt

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
    Panel panel;
    panel.letter_above = true;
    panel.height = [extent, each, caption](double width) {
        return each(width) * extent.height() / extent.width() + caption;
    };
    panel.draw = [moments, extent, each, caption](Canvas& canvas, const Rect& place) {
        const double width = each(place.width);
        const auto count = static_cast<double>(moments.size());
        double x = place.x + 0.5 * (place.width - count * width - between_drawings * (count - 1.0));
        for (const Moment& moment : moments) {
            draw_moment(canvas, {x, place.y, width, place.height - caption}, moment, extent);
            canvas.text({x + 0.5 * width, place.bottom() - caption + 3.0}, moment.caption, Across::centre, Down::top);
            x += width + between_drawings;
        }
    };
    return panel;
}

}  // namespace crackle::plot
