// SPDX-License-Identifier: GPL-3.0-or-later
// Tests values of a curve at a strain.

#include "specimens/recordings/curve_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crackle {
namespace {

TEST(CurvePoints, AreTheRowsThatHaveBothNumbers) {
    NumberTable table;
    table.names = {"time", "axial_stress", "axial_strain"};
    table.columns = {{0.0, 1.0, 2.0}, {10.0, 20.0, std::nan("")}, {0.0, 0.5, 1.0}};
    EXPECT_EQ(strain_and_stress(table), (CurvePoints{{0.0, 10.0}, {0.5, 20.0}}));
    table.names[1] = "stress";
    EXPECT_TRUE(strain_and_stress(table).empty());
}

TEST(CurvePoints, HaveTheStressBetweenThemWhereAStrainIsFirstReached) {
    const CurvePoints curve{{0.0, 0.0}, {1.0, 10.0}, {0.5, 4.0}, {2.0, 6.0}};  // a curve with one unloading
    EXPECT_EQ(stress_at(curve, 0.25), 2.5);
    EXPECT_EQ(stress_at(curve, 1.0), 10.0);
    EXPECT_EQ(stress_at(curve, 1.25), 5.0);
    EXPECT_TRUE(std::isnan(stress_at(curve, 2.5)));
    EXPECT_TRUE(std::isnan(stress_at({}, 0.0)));
}

}  // namespace
}  // namespace crackle
