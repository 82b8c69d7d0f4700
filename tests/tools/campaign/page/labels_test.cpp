// SPDX-License-Identifier: GPL-3.0-or-later
// Tests labels for the axes of a plan, with symbols and units.

#include "tools/campaign/page/labels.hpp"

#include <gtest/gtest.h>

namespace crackle::tools {
namespace {

TEST(Labels, HaveSymbolsAndTheUnitThatHolds) {
    EXPECT_EQ(axis_label("confinement.pressure", true).name, "confining pressure σ₃");
    EXPECT_EQ(axis_label("confinement.pressure", true).unit, "Pa");
    EXPECT_EQ(axis_label("confinement.pressure", false).unit, "N/m");
    EXPECT_EQ(axis_label("material.friction_angle", true).unit, "°");
    EXPECT_EQ(axis_label("mineral[2].friction_angle", true).name, "mineral 2 friction angle");
    EXPECT_EQ(axis_label("mineral[2].friction_angle", true).unit, "°");
    EXPECT_EQ(axis_label("mesh.kind", true).unit, "");
}

TEST(Labels, ValuesHaveTheirPrefix) {
    EXPECT_EQ(spoken_setting("confinement.pressure", 1e7, true), "confining pressure σ₃ 10 MPa");
    EXPECT_EQ(spoken_setting("confinement.pressure", 0.0, true), "confining pressure σ₃ 0 Pa");
    EXPECT_EQ(spoken_setting("material.friction_angle", 35.0, false), "friction angle φ 35°");
    EXPECT_EQ(spoken_setting("mesh.kind", std::string("voronoi"), false), "mesh kind voronoi");
    PointSummary point;
    point.axes = {{"mesh.kind", std::string("voronoi")}, {"material.friction_angle", 35.0}};
    EXPECT_EQ(spoken_point(point), "mesh kind voronoi, friction angle φ 35°");
    EXPECT_EQ(spoken_point(point, "mesh.kind"), "friction angle φ 35°");
}

}  // namespace
}  // namespace crackle::tools
