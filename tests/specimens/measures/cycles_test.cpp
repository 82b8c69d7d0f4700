// SPDX-License-Identifier: GPL-3.0-or-later
// Tests cycles of unloading in the rows of a curve.

#include "specimens/measures/cycles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

CurveRow row(double strain, double stress, double lateral) {
    CurveRow r;
    r.axial_strain = strain;
    r.axial_stress = stress;
    r.lateral_strain = lateral;
    return r;
}

/// Up to (4, 40), down to (2, 10) along a straight line, and up again along another that ends at (5, 42).
std::vector<CurveRow> loop() {
    return {row(0, 0, 0),    row(4, 40, 1.0), row(3, 25, 0.8), row(2, 10, 0.6),
            row(3, 26, 0.8), row(5, 42, 1.4), row(6, 43, 2.0)};
}

TEST(LoadingCycles, OfKnownLinesAreThoseLines) {
    const std::vector<CurveRow> rows = loop();
    const auto cycles = find_cycles(rows, true);
    ASSERT_EQ(cycles.size(), 1U);
    const LoadingCycle& c = cycles[0];
    EXPECT_EQ(c.strain, 4.0);
    EXPECT_EQ(c.low_stress, 10.0);
    EXPECT_TRUE(agrees("modulus", c.modulus, 15.0, 1e-14));
    EXPECT_TRUE(agrees("Poisson's ratio", c.poissons_ratio, 0.2, 1e-14));
    EXPECT_TRUE(agrees("permanent strain", c.permanent_strain, 2.0 - 10.0 / 15.0, 1e-14));
    // Unloading: -(40+25)/2 - (25+10)/2 = -50. Loading: (10+26)/2 up to 3, then (26+34)/2 up to 4, where the stress is
    // 34.
    EXPECT_TRUE(agrees("loop", c.loop, 18.0 + 30.0 - 50.0, 1e-14));
    EXPECT_TRUE(agrees("Poisson's ratio of a pulled one", find_cycles(rows, false)[0].poissons_ratio, -0.2, 1e-14));
}

TEST(LoadingCycles, OneThatTheCurveDoesNotEndHasNoLoss) {
    std::vector<CurveRow> rows = loop();
    rows.resize(4);
    const auto cycles = find_cycles(rows, true);
    ASSERT_EQ(cycles.size(), 1U);
    EXPECT_TRUE(std::isnan(cycles[0].loop));
    EXPECT_TRUE(agrees("modulus", cycles[0].modulus, 15.0, 1e-14));
    rows.resize(2);
    EXPECT_TRUE(find_cycles(rows, true).empty());
}

TEST(LoadingCycles, SayWhetherAnythingHasBrokenOrSlidAndWhatThePlatensDifferBy) {
    std::vector<CurveRow> rows = loop();
    for (CurveRow& row : rows) row.stress_top = row.stress_bottom = row.axial_stress;
    rows[1].stress_top += 2.0, rows[1].stress_bottom -= 2.0;  // the point of reversal
    rows[3].stress_top -= 1.0, rows[3].stress_bottom += 1.0;  // the lowest point
    const LoadingCycle plain = find_cycles(rows, true)[0];
    EXPECT_TRUE(plain.unbroken && plain.linear);
    EXPECT_TRUE(agrees("error of the modulus", plain.modulus_error, (2.0 + 1.0) / (40.0 - 10.0), 1e-14));
    for (std::int64_t CurveRow::*count :
         {&CurveRow::bonds_slid, &CurveRow::points_sliding, &CurveRow::contacts_gained}) {
        std::vector<CurveRow> other = rows;
        other[2].*count = 1;
        const LoadingCycle c = find_cycles(other, true)[0];
        EXPECT_TRUE(c.unbroken);
        EXPECT_FALSE(c.linear);
    }
    for (std::size_t k = 2; k < rows.size(); ++k) rows[k].bonds_broken = 1;
    const LoadingCycle broken = find_cycles(rows, true)[0];
    EXPECT_FALSE(broken.unbroken || broken.linear);
}

TEST(LoadingCycles, OfOneAmplitudeAreCountedEach) {
    // Three times to about 4: slightly beyond the first reversal, and slightly below it.
    const std::vector<CurveRow> rows{row(0, 0, 0),       row(4, 40, 1.0),    row(3, 25, 0.8), row(2, 10, 0.6),
                                     row(3, 26, 0.8),    row(4.5, 41, 1.1),  row(3, 24, 0.8), row(2.5, 15, 0.7),
                                     row(4.25, 40, 1.0), row(2.25, 20, 0.6), row(5, 44, 1.5), row(6, 45, 2.0)};
    const auto cycles = find_cycles(rows, true);
    ASSERT_EQ(cycles.size(), 3U);
    EXPECT_EQ(cycles[0].strain, 4.0);
    EXPECT_EQ(cycles[1].strain, 4.5);
    EXPECT_EQ(cycles[2].strain, 4.25);
    EXPECT_TRUE(agrees("modulus of the second", cycles[1].modulus, 26.0 / 2.0, 1e-14));
    EXPECT_TRUE(agrees("modulus of the third", cycles[2].modulus, 20.0 / 2.0, 1e-14));
    // Unloading: -(41+24)/2·1.5 - (24+15)/2·0.5; loading from 2.5 to 4.25, the next reversal.
    EXPECT_TRUE(agrees("loop of the second", cycles[1].loop, -48.75 - 9.75 + 0.5 * (15.0 + 40.0) * 1.75, 1e-14));
    EXPECT_FALSE(std::isnan(cycles[2].loop));
}

TEST(LoadingCycles, OfASpecimenThatFailsWhileItIsUnloadedAreSeen) {
    std::vector<CurveRow> rows = loop();
    for (std::size_t k = 1; k < rows.size(); ++k) rows[k].bonds_broken = 300;  // before the unloading
    for (std::size_t k = 3; k < rows.size(); ++k) rows[k].bonds_broken = 305;  // during it
    for (std::size_t k = 4; k < rows.size(); ++k) rows[k].bonds_broken = 400;  // during reloading, which does not count
    const LoadingCycle cycle = find_cycles(rows, true)[0];
    EXPECT_EQ(cycle.breaks_of_unloading, 5);
    EXPECT_FALSE(cycle.collapsed(1000));  // 0.5 % of the bonds
    EXPECT_TRUE(cycle.collapsed(999));
}

TEST(LoadingCycles, FirstLoadingIsTheCurveWithoutThemAndKeepsItsPeak) {
    const FirstLoading first = first_loading(loop(), 5);
    ASSERT_EQ(first.rows.size(), 4U);
    EXPECT_EQ(first.rows[2].axial_strain, 5.0);
    EXPECT_EQ(first.peak_row, 2);
    EXPECT_EQ(first_loading(loop(), -1).peak_row, -1);
}

}  // namespace
}  // namespace crackle
