// SPDX-License-Identifier: GPL-3.0-or-later
// Panels that make up a figure: diagrams and drawings whose height follows from their width. They are placed one
// below the other or side by side.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "specimens/recordings/measured_curve.hpp"
#include "specimens/recordings/recording.hpp"
#include "tools/plot/canvas.hpp"

namespace crackle::plot {

struct Panel {
    std::function<double(const Canvas& measure, double width)> height;  ///< pt; the canvas is used only to measure text
    std::function<void(Canvas&, const Rect&)> draw;
    bool letter_above = false;  ///< whether the panel's letter, (a), (b), ..., needs a line of its own
    std::string title = {};     ///< title of the test shown, placed beside the letter; may be empty
    /// Positions of letters after the first in a panel of this width, pt from its left edge; usually empty.
    std::function<std::vector<double>(double width)> more_letters = {};
};

/// A test and its appearance in diagrams.
struct PlottedTest {
    const TestResults* results = nullptr;
    std::string label;
    std::size_t colour = 0;
    bool dashed = false;
};

/// Axial stress against axial strain, and below it the number of broken bonds. For one test, breaks are shown per
/// strain interval and by mode; for several tests, as running totals. If curves of one kind of test are too small on
/// the common scale, an inset shows them enlarged. Measured curves are drawn as dashed lines, and then there is no
/// inset.
Panel stress_strain(const std::vector<PlottedTest>& tests, const std::vector<LabelledCurve>& measured = {});
/// Number of bonds broken, per strain interval and by mode, and the running total (right axis). For several tests, only
/// the running totals are shown.
Panel breaks(const std::vector<PlottedTest>& tests);

/// Area strain against axial strain. Area strain is axial minus lateral strain, positive if the area shrinks. A single
/// test is shown with the part caused by cracks, and the point of crack damage. Values far below the lowest value
/// before the peak are cut off.
Panel area_strain(const std::vector<PlottedTest>& tests);
/// Whether the specimen was pulled apart between platens.
bool pulled(const TestResults& results);
/// Whether the area strain is known: the test is uniaxial, and all rows contain a lateral strain.
bool has_area_strain(const TestResults& results);

/// A disc drawn on a specimen.
struct DrawnMark {
    Vec2 place;           // m
    double radius = 1.0;  ///< pt, radius of the disc
    Colour colour;
};
/// A specimen at one moment.
struct DrawnMoment {
    const Recording* recording = nullptr;
    std::size_t frame = 0;
    std::vector<std::string> caption;  ///< lines in Pango markup
    bool cracks = true;
    std::vector<DrawnMark> marks = {};
    bool lettered =
        false;  ///< whether this drawing has its own letter within a row; the first drawing of a row always has one
    bool forces = false;  ///< whether the stresses of faces are drawn, and the openings of cracks as line widths
};
struct DrawingStyle {
    double magnify = 1.0;  ///< magnification of displacements
};
/// Specimens side by side at the same scale. Cracks are coloured by mode and drawn on both faces that they separated. A
/// fragment is drawn completely or, if it has moved far away, not at all; the caption gives the number of particles
/// left out. Stresses of faces and openings have the same scale in all drawings.
/// @param folders for each moment, the folder of its test, which contains the cracks of each frame
Panel drawings(const std::vector<DrawnMoment>& moments, const std::vector<std::filesystem::path>& folders,
               const DrawingStyle& style);

/// Number of events against magnitude, for all tests together. The diagram shows the number of events of at least
/// each magnitude, the number in each interval of 0.1, and the line fitted above the magnitude of completeness. A text
/// above the diagram gives b, its error, the number of events used, damping and density.
Panel magnitude_frequency(const std::vector<PlottedTest>& tests);
/// Positions of acoustic events on the specimens at these moments, side by side. The colour of a mark shows the strain
/// at which the event began, and its size the magnitude.
Panel emission_map(std::vector<DrawnMoment> moments, const std::vector<std::filesystem::path>& folders);
/// Whether the test wrote an ae.csv.
bool has_emission(const TestResults& results);

/// A figure with panels one below the other. @param width pt @return bytes of the file
std::string figure(const std::vector<Panel>& panels, const std::string& title, double width, Format format,
                   const SheetStyle& style);
/// A figure with rows of panels. Panels in a row are side by side, equally wide and as high as the highest of them.
std::string figure(const std::vector<std::vector<Panel>>& rows, const std::string& title, double width, Format format,
                   const SheetStyle& style);

}  // namespace crackle::plot
