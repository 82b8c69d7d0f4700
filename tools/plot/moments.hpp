// SPDX-License-Identifier: GPL-3.0-or-later
// A specimen at one instant, prepared for drawing: its cells, cracks, joints and forces at their current positions.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "tools/plot/face_bands.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// Light colours that also differ as shades of grey, because cracks are drawn over them.
const Colour& mineral_colour(std::size_t number);

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

/// A crack, or a face on a joint trace that is still bonded or was open from the start.
struct FaceLine {
    enum class Kind : std::uint8_t { tension, shear, joint, open_joint };

    Vec2 from, to;
    Kind kind = Kind::tension;
    double opening = 0.0;  // opening of a crack, m
};

/// The state at one instant, prepared for drawing.
struct Moment {
    std::vector<std::vector<Vec2>> outlines;  // outlines of the cells; a single point for a circle
    std::vector<bool> shown;                  // whether each cell is drawn
    const std::vector<RecordedCell>* cells = nullptr;
    std::vector<FaceLine> faces;  // joints first, so that cracks are drawn over them
    std::vector<FaceBand> bands;
    bool forces = false;  // whether bands are drawn, and the openings of cracks as line widths
    std::vector<DrawnMark> marks;
    std::vector<std::string> caption;   // lines of text
    std::vector<std::string> minerals;  // empty if the rock has only one material
    Extent extent;

    /// Mean size of a cell, m.
    double cell_size() const;
    const Colour& colour_of_cell(std::size_t k) const;
};

/// Index of the frame for a word of --at (start, peak, end), or of the frame nearest to a given strain.
/// @throws InputError if the test has no such frame
std::size_t frame_at(const Recording& test, const std::string& at);

/// Reads a frame and prepares it for drawing. @param folder the test's folder, with the cracks and joints of all frames
Moment moment_of(const DrawnMoment& drawn, const std::filesystem::path& folder, const DrawingStyle& style);

}  // namespace crackle::plot
