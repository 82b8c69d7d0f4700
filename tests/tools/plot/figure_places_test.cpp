// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the positions of marks in figures, relative to marks of the same figure whose positions are known.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/joint_report.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/drawn_figure.hpp"
#include "tests/support/sample_results.hpp"
#include "tools/joints/joint_panels.hpp"
#include "tools/plot/campaign_panels.hpp"
#include "tools/plot/envelope_panels.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {
namespace {

using testing::corners_of;
using testing::frames_of;
using testing::lines_of;

constexpr double width = 400.0;   // pt
constexpr double written = 2e-3;  // pt, since numbers in an SVG have four digits

std::string drawn(const Panel& panel) { return figure({panel}, "", width, Format::svg, {}); }

struct Box {
    double left, right, top, bottom;
    Vec2 middle() const { return {0.5 * (left + right), 0.5 * (top + bottom)}; }
};

/// Shapes of an SVG that are filled with a colour, in drawing order.
std::vector<Box> filled(const std::string& svg, const Colour& fill) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<Box> boxes;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value();
        const std::size_t at = style.find("fill:rgb(");
        std::array<double, 3> found{};
        if (at == std::string::npos ||
            std::sscanf(style.c_str() + at, "fill:rgb(%lf%%,%lf%%,%lf%%)", &found[0], &found[1], &found[2]) != 3)
            continue;
        if (std::abs(found[0] - 100.0 * fill.red) + std::abs(found[1] - 100.0 * fill.green) +
                std::abs(found[2] - 100.0 * fill.blue) >
            0.02)
            continue;
        const std::vector<Vec2> corners = corners_of(node.node().attribute("d").value());
        if (corners.empty()) continue;
        const auto [left, right] = std::ranges::minmax(corners, {}, &Vec2::x);
        const auto [top, bottom] = std::ranges::minmax(corners, {}, &Vec2::y);
        boxes.push_back({left.x, right.x, top.y, bottom.y});
    }
    return boxes;
}

/// Results of a test with only these columns.
TestResults results_of(const std::string& summary, NumberTable curve) {
    TestResults results;
    results.summary = parse_summary(summary);
    results.curve = std::move(curve);
    return results;
}

// Four magnitudes of -6.34 and two of -5.84, in the intervals -6.4 to -6.3 and -5.9 to -5.8.
TEST(MagnitudeFrequency, RingsLieAtTheMiddleOfTheirBinAndDiscsAtTheNumberAtLeastSoLarge) {
    TestResults results = results_of("{}", {});
    results.emission = NumberTable{{"moment_magnitude"}, {{-6.34, -5.84, -6.34, -6.34, -5.84, -6.34}}};
    const std::string svg = drawn(magnitude_frequency({{&results, "one"}}));
    const std::vector<Box> discs = filled(svg, ink), rings = filled(svg, colour("#ffffff"));
    ASSERT_EQ(discs.size(), 7U) << "and the legend's";
    ASSERT_EQ(rings.size(), 3U);
    const Vec2 low = discs[1].middle(), high = discs[6].middle();
    const double magnitude = (high.x - low.x) / 0.5, decade = (high.y - low.y) / std::log10(6.0);
    EXPECT_NEAR(rings[1].middle().x, low.x - 0.01 * magnitude, written);
    EXPECT_NEAR(rings[2].middle().x, high.x - 0.01 * magnitude, written);
    // The numbers fall from 6 at the first to 1 at the last, whose logarithm is 0.
    EXPECT_NEAR(rings[1].middle().y, high.y - std::log10(4.0) * decade, written);
    EXPECT_NEAR(rings[2].middle().y, high.y - std::log10(2.0) * decade, written);
    for (int k = 1; k <= 6; ++k)
        EXPECT_NEAR(discs[static_cast<std::size_t>(k)].middle().y, high.y - std::log10(7.0 - k) * decade, written) << k;
    // On the axis, a magnitude of 0.5 has the length given by the frame's scale, and its lower end is below 0.
    const auto frames = frames_of(svg);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_GT(frames[0][1].y, high.y);
    EXPECT_LT(frames[0][0].x, low.x);
}

// Events of the sample move from the lower end upwards.
TEST(EmissionMap, EarlyEventsAreVioletAndLateOnesYellow) {
    const testing::ScratchFolder scratch;
    testing::SampleTest heard;
    heard.emission = 40;
    testing::write_sample_results(scratch / "heard", heard);
    const Recording recording = read_test_recording(scratch / "heard", 10);
    const std::string svg = drawn(emission_map({{&recording, 0, {}}}, {scratch / "heard"}));
    const std::vector<Box> early = filled(svg, colour("#440154")), late = filled(svg, colour("#fde725"));
    ASSERT_EQ(early.size(), 1U);
    ASSERT_EQ(late.size(), 1U);
    EXPECT_GT(early[0].middle().y, late[0].middle().y + 50.0) << "the lower end is the larger y";
}

// With intervals of 0.1 thousandths, breaks at 2 and at 4 thousandths belong to the intervals that end there.
TEST(Breaks, BarsStandAtTheirIntervals) {
    TestResults results =
        results_of(R"({"kind": "compression"})", {{"axial_strain", "bonds_broken"}, {{0.0, 3e-3, 6e-3}, {0, 1, 2}}});
    results.events = NumberTable{{"axial_strain", "mode"}, {{2e-3, 4e-3}, {0.0, 0.0}}};
    const std::string svg = drawn(breaks({{&results, "one"}}));
    std::vector<Box> bars = filled(svg, tension_colour);
    ASSERT_EQ(bars.size(), 3U) << "and the legend's";
    std::ranges::sort(bars, std::ranges::greater{}, [](const Box& bar) { return bar.bottom - bar.top; });
    std::ranges::sort(bars.begin(), bars.begin() + 2, {}, &Box::left);
    const double thousandth = (bars[1].left - bars[0].left) / 2.0;
    EXPECT_NEAR(bars[0].left - frames_of(svg)[0][0].x, 1.9 * thousandth, 10.0 * written);
    EXPECT_NEAR(bars[0].right - bars[0].left, 0.9 * 0.1 * thousandth, 10.0 * written);
}

// Under a pressure p the stress is p + Eε, and the sides move by νε + 50ε². The area strain is (1-ν)ε - 50ε², of which
// (1-ν)ε is elastic and -50ε² is due to cracks: 3.2e-3 and -0.8e-3 at ε = 4e-3. If p were included in the elastic part,
// the curves would be (1-ν)p/E = 8e-4 apart at the beginning.
TEST(AreaStrain, OfCracksCountsFromThePressure) {
    constexpr double modulus = 1e9, ratio = 0.2, pressure = 1e6;
    NumberTable curve{{"axial_strain", "lateral_strain", "axial_stress"}, {{}, {}, {}}};
    for (int k = 0; k <= 40; ++k) {
        const double strain = 1e-4 * k;
        curve.columns[0].push_back(strain);
        curve.columns[1].push_back(ratio * strain + 50.0 * strain * strain);
        curve.columns[2].push_back(pressure + modulus * strain);
    }
    const TestResults results = results_of(fmt::format(R"({{"kind": "biaxial", "confining_pressure": {},
        "youngs_modulus": {}, "poissons_ratio": {}, "peak_strain": 4e-3}})",
                                                       pressure, modulus, ratio),
                                           curve);
    std::vector<std::vector<Vec2>> curves;
    for (const std::vector<Vec2>& line : lines_of(drawn(area_strain({{&results, "one"}}))))
        if (line.size() > 10) curves.push_back(line);
    ASSERT_EQ(curves.size(), 2U) << "first the area, then the cracks";
    const double unit = (curves[0].front().y - curves[0].back().y) / 2.4e-3;
    EXPECT_GT(unit * 2.4e-3, 50.0) << "pt, many times the written size";
    EXPECT_NEAR(curves[1].front().y, curves[0].front().y, written);
    EXPECT_NEAR(curves[1].back().y - curves[1].front().y, 0.8e-3 * unit, 2.0 * written);
}

// Circles as in the test of the program: from σ3 to σ1, and from -T to 0.
TEST(MohrCircles, OfTensionsEndAtMinusTheirStrength) {
    std::vector<StrengthPoint> tests;
    for (const double pressure : {0.0, 10e6, 20e6})
        for (const char* packing : {"1", "2"}) tests.push_back({packing, pressure, 100e6 + 4.0 * pressure});
    MeanFigure tension;
    tension.count = 2;
    tension.mean = tension.low = tension.high = 40e6;
    const EnvelopeFigure figure{fit_envelope(tests), {{}, tests, {40e6, 40e6}, {}, 0, "Pa"}, tension};
    std::vector<Box> circles;
    for (const std::vector<Vec2>& line : lines_of(drawn(mohr_circles(figure)))) {
        if (line.size() != 201 || std::abs(line.front().y - line.back().y) > written) continue;
        circles.push_back({line.back().x, line.front().x, 0.0, 0.0});
    }
    ASSERT_EQ(circles.size(), 4U);
    const double mega = (circles[0].right - circles[0].left) / 100.0;
    EXPECT_NEAR(circles[1].left - circles[0].left, 10.0 * mega, 10.0 * written);
    EXPECT_NEAR(circles[1].right - circles[0].left, 140.0 * mega, 10.0 * written);
    EXPECT_NEAR(circles[3].left - circles[0].left, -40.0 * mega, 10.0 * written);
    EXPECT_NEAR(circles[3].right - circles[0].left, 0.0, 10.0 * written);
}

// Means 1, 2, 3 at x = 1, 2, 3; the second interval extends farther upwards.
TEST(OverAxis, TheLineGoesThroughTheMeans) {
    const Series series{
        "one",
        {1.0, 2.0, 3.0},
        {{"", {0.9, 1.1}, 1.0, 0.9, 1.1}, {"", {1.9, 2.9}, 2.0, 1.9, 2.9}, {"", {2.9, 3.1}, 3.0, 2.9, 3.1}}};
    std::vector<std::vector<Vec2>> lines;
    for (const std::vector<Vec2>& line : lines_of(drawn(over_axis("x", "", "y", "", {series}))))
        if (line.size() == 3 && line[0].x < line[1].x && line[1].x < line[2].x) lines.push_back(line);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NEAR(lines[0][1].x, 0.5 * (lines[0][0].x + lines[0][2].x), written);
    EXPECT_NEAR(lines[0][1].y, 0.5 * (lines[0][0].y + lines[0][2].y), written);
    EXPECT_LT(lines[0][2].y, lines[0][0].y - 20.0);
}

// A parabola with its peak in row 10; cracks begin at the stress of row 4.
TEST(StressStrain, MarksLieOnTheCurve) {
    NumberTable curve{{"axial_strain", "axial_stress", "bonds_broken"}, {{}, {}, {}}};
    for (int k = 0; k <= 20; ++k) {
        curve.columns[0].push_back(1e-4 * k);
        curve.columns[1].push_back(1e5 * k * (20 - k));
        curve.columns[2].push_back(0.0);
    }
    TestResults results = results_of(
        R"({"kind": "compression", "peak_strain": 1e-3, "peak_stress": 1e7, "crack_initiation_stress": 6.4e6})", curve);
    results.events = NumberTable{{"axial_strain", "mode"}, {{}, {}}};
    const std::string svg = drawn(stress_strain({{&results, "one"}}));
    std::vector<std::vector<Vec2>> lines;
    for (const std::vector<Vec2>& line : lines_of(svg))
        if (line.size() == 21) lines.push_back(line);
    ASSERT_EQ(lines.size(), 1U);
    const std::vector<Box> marks = filled(svg, colour("#ffffff"));
    ASSERT_EQ(marks.size(), 2U);
    for (const auto& [mark, row] : {std::pair(0, 10), std::pair(1, 4)}) {
        const Vec2 at = marks[static_cast<std::size_t>(mark)].middle(), on = lines[0][static_cast<std::size_t>(row)];
        EXPECT_NEAR(at.x, on.x, written) << row;
        EXPECT_NEAR(at.y, on.y, written) << row;
    }
    // Its position from the axes: strain and stress 0 are at their corner.
    const std::vector<Vec2> frame = frames_of(svg)[0];
    EXPECT_NEAR(lines[0][0].x, frame[1].x, written);
    EXPECT_NEAR(lines[0][0].y, frame[1].y, written);
    EXPECT_NEAR(lines[0][10].x - lines[0][0].x, lines[0][20].x - lines[0][10].x, 2.0 * written);
    EXPECT_NEAR(lines[0][20].y, frame[1].y, written);
    EXPECT_NEAR(lines[0][0].y - lines[0][4].y, 0.64 * (lines[0][0].y - lines[0][10].y), 2.0 * written);
}

TEST(Distributions, ValuesMeansAndIntervalsLieAtTheirNumbers) {
    const std::string svg = drawn(distributions("strength", "Pa", {{"one", {1e7, 2e7}, 1.5e7, 1.2e7, 1.8e7}}));
    const std::vector<Box> values = filled(svg, tinted(series_colour(0), 0.55));
    ASSERT_EQ(values.size(), 2U);
    const double low = values[0].middle().x, ten_mega = values[1].middle().x - low;
    const std::vector<Box> mean = filled(svg, colour("#ffffff"));
    ASSERT_EQ(mean.size(), 1U);
    EXPECT_NEAR(mean[0].middle().x, low + 0.5 * ten_mega, written);
    bool found = false;
    for (const std::vector<Vec2>& line : lines_of(svg)) {
        if (line.size() != 2 || std::abs(line[0].y - mean[0].middle().y) > written || line[0].y != line[1].y) continue;
        found = std::abs(line[0].x - low - 0.2 * ten_mega) < written &&
                std::abs(line[1].x - low - 0.8 * ten_mega) < written;
        if (found) break;
    }
    EXPECT_TRUE(found) << "the interval, through the mean";
}

TEST(StrengthsOverConfinement, MeansAndTensionsLieAtTheirStresses) {
    std::vector<StrengthPoint> tests;
    for (const double pressure : {0.0, 10e6, 20e6})
        for (const char* packing : {"1", "2"}) tests.push_back({packing, pressure, 100e6 + 4.0 * pressure});
    MeanFigure tension;
    tension.count = 2;
    tension.mean = tension.low = tension.high = 40e6;
    const EnvelopeFigure figure{fit_envelope(tests), {{}, tests, {40e6, 40e6}, {}, 0, "Pa"}, tension};
    const std::vector<Box> means = filled(drawn(strengths_over_confinement(figure)), colour("#ffffff"));
    ASSERT_EQ(means.size(), 4U);
    const Vec2 first = means[0].middle(), last = means[2].middle();
    EXPECT_NEAR(means[1].middle().x, 0.5 * (first.x + last.x), written);
    EXPECT_NEAR(means[1].middle().y, 0.5 * (first.y + last.y), written);
    EXPECT_NEAR(means[3].middle().x, first.x - 2.0 * (last.x - first.x), 3.0 * written);
    EXPECT_NEAR(means[3].middle().y, first.y + 100.0 / 80.0 * (first.y - last.y), 3.0 * written);
}

JointNetwork one_trace() {
    JointNetwork network;
    network.box = {0.0, 2.0, 0.0, 1.0, {}};
    network.sources.push_back({"survey", {}});
    network.traces.push_back({{{0.5, 0.25}, {1.5, 0.75}}, 0, 1.118, true});
    return network;
}

TEST(TraceMap, TracesLieInTheirBox) {
    const std::string svg = drawn(trace_map(one_trace()));
    const std::vector<Vec2> frame = frames_of(svg)[0];
    const double metre = 0.5 * (frame[2].x - frame[1].x);
    EXPECT_NEAR(frame[1].y - frame[0].y, metre, written) << "both axes have the same scale";
    bool found = false;
    for (const std::vector<Vec2>& line : lines_of(svg)) {
        if (line.size() != 2) continue;
        found = found || (std::abs(line[0].x - frame[1].x - 0.5 * metre) < written &&
                          std::abs(frame[1].y - line[0].y - 0.25 * metre) < written &&
                          std::abs(line[1].x - frame[1].x - 1.5 * metre) < written &&
                          std::abs(frame[1].y - line[1].y - 0.75 * metre) < written);
    }
    EXPECT_TRUE(found);
}

// All traces are at 30 degrees, in the interval from 25 to 35: two petals, with outer edges there and opposite.
TEST(TraceRose, PetalsPointAlongTheTraces) {
    JointReport report;
    report.sources.resize(1);
    for (SourceReport* source : {&report.sources[0], &report.all}) {
        source->rose.begins = -5.0;
        source->rose.add(std::numbers::pi / 6.0, 2.0);
    }
    const std::vector<Box> petals = filled(drawn(trace_rose(one_trace(), report)), series_colour(0));
    ASSERT_EQ(petals.size(), 2U);
    const Box &right = petals[0], &left = petals[1];
    const Vec2 centre{0.5 * (right.left + left.right), 0.5 * (right.bottom + left.top)};
    EXPECT_NEAR(right.left, centre.x, written) << "they meet in the middle";
    // The right petal ends at 25 degrees in x and at 35 degrees in y.
    const double radius = (right.right - centre.x) / std::cos(25.0 * std::numbers::pi / 180.0);
    EXPECT_NEAR(centre.y - right.top, radius * std::sin(35.0 * std::numbers::pi / 180.0), 2.0 * written);
    EXPECT_NEAR(left.bottom - centre.y, radius * std::sin(35.0 * std::numbers::pi / 180.0), 2.0 * written);
}

}  // namespace
}  // namespace crackle::plot
