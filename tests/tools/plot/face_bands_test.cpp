// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the bands that show forces of faces: their corners, and their shapes and colours in a figure.

#include "tools/plot/face_bands.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "tools/plot/panels.hpp"

namespace crackle::plot {
namespace {

using Corners = std::vector<Vec2>;

void expect_corners(const Corners& found, const Corners& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k].x, expected[k].x, 1e-12) << k;
        EXPECT_NEAR(found[k].y, expected[k].y, 1e-12) << k;
    }
}

// The face runs up the y axis, so its normal is the x axis.
TEST(FaceBands, AreTrapezoidsThatShearSlants) {
    const FaceBand pressed{{0.0, 0.0}, {0.0, 2.0}, 1.0, 3.0, 0.5, false};
    const std::vector<BandPart> parts = parts_of(pressed, 0.1);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_TRUE(parts[0].compression);
    expect_corners(parts[0].corners, {{0.1, -0.05}, {0.3, 1.95}, {-0.3, 2.05}, {-0.1, 0.05}});
}

TEST(FaceBands, ChangeColourWhereTheStressChangesItsSign) {
    FaceBand bent{{0.0, 0.0}, {0.0, 2.0}, -1.0, 3.0, 0.0, false};
    const std::vector<BandPart> parts = parts_of(bent, 0.1);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_FALSE(parts[0].compression);
    expect_corners(parts[0].corners, {{-0.1, 0.0}, {0.0, 0.5}, {0.0, 0.5}, {0.1, 0.0}});
    EXPECT_TRUE(parts[1].compression);
    expect_corners(parts[1].corners, {{0.0, 0.5}, {0.3, 2.0}, {-0.3, 2.0}, {0.0, 0.5}});
    bent.broken = true;
    ASSERT_EQ(parts_of(bent, 0.1).size(), 1U) << "a broken face carries no tension";
    EXPECT_TRUE(parts_of(bent, 0.1)[0].compression);
}

/// Three squares of 1 m beside each other. The first face is pressed, the second one pulled.
Recording three_squares() {
    Recording recording;
    recording.kind = Recording::Kind::test;
    for (int k = 0; k < 3; ++k) {
        RecordedCell cell;
        cell.id = k;
        cell.centre = {k + 0.5, 0.5};
        cell.outline = {{k + 0.0, 0.0}, {k + 1.0, 0.0}, {k + 1.0, 1.0}, {k + 0.0, 1.0}};
        recording.cells.push_back(cell);
    }
    for (int k = 0; k < 2; ++k) {
        RecordedBond bond;
        bond.i = k;
        bond.j = k + 1;
        bond.place = {k + 1.0, 0.5};
        bond.begin = {k + 1.0, 0.0};
        bond.end = {k + 1.0, 1.0};
        recording.bonds.push_back(bond);
    }
    recording.frames.emplace_back();
    recording.frame = [](std::size_t) {
        RecordedFrame frame;
        frame.ux = frame.uy = frame.angle = {0.0, 0.0, 0.0};
        frame.normal_force = {2e6, -1e6};
        frame.shear_force = frame.state = {0.0, 0.0};
        frame.stress_begin = frame.stress_end = {2e6, -1e6};
        return frame;
    };
    return recording;
}

/// Widths of the shapes filled with a colour, pt, in drawing order.
std::vector<double> widths_of(const std::string& svg, const Colour& fill) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<double> widths;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value(), path = node.node().attribute("d").value();
        std::array<double, 3> found{};
        const std::size_t at = style.find("fill:rgb(");
        if (at == std::string::npos ||
            std::sscanf(style.c_str() + at, "fill:rgb(%lf%%,%lf%%,%lf%%)", &found[0], &found[1], &found[2]) != 3 ||
            std::abs(found[0] - 100.0 * fill.red) + std::abs(found[1] - 100.0 * fill.green) +
                    std::abs(found[2] - 100.0 * fill.blue) >
                0.02)
            continue;
        double low = 1e9, high = -1e9;
        for (std::size_t letter = 0; letter < path.size(); ++letter) {
            double x = 0.0;
            if ((path[letter] == 'M' || path[letter] == 'L') &&
                std::sscanf(path.c_str() + letter + 1, "%lf", &x) == 1) {
                low = std::min(low, x);
                high = std::max(high, x);
            }
        }
        widths.push_back(high - low);
    }
    return widths;
}

TEST(FaceBands, AreAsWideAsTheirStressInTheColourOfItsSign) {
    const Recording recording = three_squares();
    EXPECT_TRUE(has_faces(recording));
    DrawnMoment moment{&recording, 0, {"caption"}};
    moment.cracks = false;
    const auto drawn = [&] { return figure({drawings({moment}, {"."}, {})}, "", 400.0, Format::svg, SheetStyle{}); };
    EXPECT_TRUE(widths_of(drawn(), band_fill(false)).empty()) << "only a drawing of forces has bands";
    moment.forces = true;
    const std::string svg = drawn();
    const std::vector<double> pulled = widths_of(svg, band_fill(false)), pressed = widths_of(svg, band_fill(true));
    ASSERT_FALSE(pulled.empty());
    ASSERT_FALSE(pressed.empty());
    EXPECT_NEAR(pressed[0] / pulled[0], 2.0, 1e-3);
}

}  // namespace
}  // namespace crackle::plot
