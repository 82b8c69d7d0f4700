// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the band of several curves against results by hand.

#include "tools/plot/campaign_panels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace crackle::plot {
namespace {

TEST(Band, IsTheMedianAndTheMiddleOfStraightLines) {
    CurveBundle bundle;
    for (int slope = 1; slope <= 11; ++slope) bundle.curves.push_back({{0.0, 0.0}, {1.0, slope}});
    const Band band = band_of(bundle, 0.1, 11);
    ASSERT_EQ(band.strain.size(), 11U);
    for (std::size_t k = 0; k < band.strain.size(); ++k) {
        EXPECT_NEAR(band.median[k], 6.0 * band.strain[k], 1e-12);
        EXPECT_NEAR(band.low[k], 2.0 * band.strain[k], 1e-12) << "one of eleven is smaller";
        EXPECT_NEAR(band.high[k], 10.0 * band.strain[k], 1e-12);
    }
}

TEST(Band, EndsWhereFewerThanHalfOfTheCurvesGoOn) {
    CurveBundle bundle;
    for (const double end : {1.0, 2.0, 3.0, 4.0, 5.0}) bundle.curves.push_back({{0.0, 1.0}, {end, 1.0}});
    bundle.curves.emplace_back();  // a test without rows
    EXPECT_EQ(band_of(bundle).strain.back(), 3.0);
    EXPECT_EQ(band_of(bundle).median.back(), 1.0);
    EXPECT_TRUE(band_of(CurveBundle{}).strain.empty());
}

TEST(Band, InterpolatesBetweenRows) {
    CurveBundle bundle;
    bundle.curves = {{{0.0, 0.0}, {0.1, 1.0}, {1.0, 10.0}}};
    const Band band = band_of(bundle, 0.1, 5);
    EXPECT_NEAR(band.median[1], 2.5, 1e-12);
    EXPECT_EQ(band.low[1], band.high[1]);
}

/// Positions of the glyphs in an SVG.
std::vector<Point> glyphs_of(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<Point> places;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='use']"))
        places.push_back({node.node().attribute("x").as_double(), node.node().attribute("y").as_double()});
    return places;
}

TEST(Distributions, LongLabelsAreBrokenBehindCommasAndStayOnTheSheet) {
    constexpr double width = 241.0;  // pt, width of a journal column
    const auto drawn = [](const std::string& label) {
        return glyphs_of(figure({distributions("peak stress", "Pa", {{label, {1e7, 2e7}, 1.5e7, 1.2e7, 1.8e7}})}, "",
                                width, Format::svg, {}));
    };
    for (const char* label : {"confining pressure σ₃ 10 MPa, friction angle φ 20°, mesh kind voronoi",
                              "a name of a test that has no comma at all and goes on far beyond its column"}) {
        double left = width, right = 0.0;
        for (const Point& glyph : drawn(label)) {
            left = std::min(left, glyph.x);
            right = std::max(right, glyph.x);
        }
        EXPECT_GE(left, 2.0 - 0.5) << label;
        EXPECT_LT(right, width - 2.0) << label;
    }
}

TEST(CurveBands, AreNamedByTheKindOfTest) {
    CurveBundle bundle;
    bundle.curves = {{{0.0, 0.0}, {1e-3, 1e6}}};
    const auto glyphs = [&](const char* kind) {
        bundle.kind = kind;
        return glyphs_of(figure({curve_bands({bundle})}, "", 241.0, Format::svg, {})).size();
    };
    EXPECT_GT(glyphs("direct_shear"), glyphs("compression") + 8) << "displacement / length";
    EXPECT_EQ(glyphs("biaxial"), glyphs("compression"));
}

TEST(Figure, ATitleStandsAboveItsPanel) {
    CurveBundle bundle;
    bundle.curves = {{{0.0, 0.0}, {1e-3, 1e6}}};
    Panel panel = curve_bands({bundle});
    const auto glyphs = [&](const char* title) {
        panel.title = title;
        return glyphs_of(figure({panel}, "", 241.0, Format::svg, {}));
    };
    const std::vector<Point> without = glyphs(""), with = glyphs("shear");
    EXPECT_EQ(with.size(), without.size() + 5);
    const auto highest = [](const std::vector<Point>& places) { return std::ranges::min(places, {}, &Point::y).y; };
    EXPECT_LT(highest(with), 12.0);
    EXPECT_GT(highest(without), 12.0);
}

}  // namespace
}  // namespace crackle::plot
