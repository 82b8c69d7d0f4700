// SPDX-License-Identifier: GPL-3.0-or-later
// What a figure is put together of: diagrams and drawings that know how high they are at a width, one below the other
// or side by side.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"
#include "tools/plot/canvas.hpp"

namespace crackle::plot {

struct Panel {
    std::function<double(const Canvas& measure, double width)> height;  ///< pt; text is measured on the canvas
    std::function<void(Canvas&, const Rect&)> draw;
    bool letter_above = false;  ///< its letter, (a), (b), ..., needs a line of its own
    std::string title = {};     ///< of its test, beside the letter; empty: none
    /// Of a panel of this width: places from its left, pt, of letters beside its first one; none in most panels.
    std::function<std::vector<double>(double width)> more_letters = {};
};

/// One test as it appears in diagrams.
struct PlottedTest {
    const TestResults* results = nullptr;
    std::string label;
    std::size_t colour = 0;
    bool dashed = false;
};

/// Axial stress over axial strain, and beneath it the bonds broken: of one test in each interval of strain, by mode, of
/// several so far. Where the tests of one kind would be slivers beside those of the other, an inset shows them larger.
Panel stress_strain(const std::vector<PlottedTest>& tests);
/// Bonds broken in each interval of strain, by mode, and so far (right axis); of several tests so far.
Panel breaks(const std::vector<PlottedTest>& tests);

/// Area strain over axial strain, axial less lateral, positive where the area shrinks; of one test beside it what
/// cracks have of it, and crack damage. What falls far below the values at the peak is left out.
Panel area_strain(const std::vector<PlottedTest>& tests);
/// Whether the specimen has a lateral strain.
bool has_area_strain(const TestResults& results);

/// A disc over a specimen.
struct DrawnMark {
    Vec2 place;           // m
    double radius = 1.0;  ///< pt
    Colour colour;
};
/// One moment of one specimen.
struct DrawnMoment {
    const Recording* recording = nullptr;
    std::size_t frame = 0;
    std::vector<std::string> caption;  ///< lines, markup
    bool cracks = true;
    std::vector<DrawnMark> marks = {};
    bool lettered = false;  ///< has a letter of its own within a row of drawings, whose first always has one
};
struct DrawingStyle {
    double magnify = 1.0;  ///< displacements
};
/// Specimens side by side at one scale, cracks coloured by mode, each on the two faces that it parted. A fragment is
/// drawn whole or, where it flew far off, not at all: the caption gives the number of particles left out.
/// @param folders  of the moments' tests, which hold the frames' cracks
Panel drawings(const std::vector<DrawnMoment>& moments, const std::vector<std::filesystem::path>& folders,
               const DrawingStyle& style);

/// Events over magnitude, of all tests together: so many at least so large, so many in each 0.1, and the fitted line
/// above the magnitude of completeness, with b, its error, the number behind it, damping and density.
Panel magnitude_frequency(const std::vector<PlottedTest>& tests);
/// Where acoustic events came, coloured by the strain when they began, sized by magnitude, on the specimens of these
/// moments side by side.
Panel emission_map(std::vector<DrawnMoment> moments, const std::vector<std::filesystem::path>& folders);
/// Whether the test wrote ae.csv.
bool has_emission(const TestResults& results);

/// A figure of panels one below the other. @param width pt @return the file's bytes
std::string figure(const std::vector<Panel>& panels, const std::string& title, double width, Format format,
                   const SheetStyle& style);
/// The same of rows of panels side by side, as wide as each other and as high as the highest of the row.
std::string figure(const std::vector<std::vector<Panel>>& rows, const std::string& title, double width, Format format,
                   const SheetStyle& style);

}  // namespace crackle::plot
