// SPDX-License-Identifier: GPL-3.0-or-later
// Tests windows, moduli and ratios for curves written by hand and for curves whose moduli are known.

#include "specimens/measures/curve_analysis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/specimens/measures/straight_curve.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::straight_curve;

TEST(Moduli, OfAStraightCurveAreItsSlope) {
    for (const bool compression : {true, false}) {
        const auto curve = straight_curve(5e6, 1e-3, 0.2, compression ? 0.3 : -0.3, 200);
        constexpr std::int64_t peak = 200;
        const Tangent initial = initial_tangent(curve, peak, compression);
        const Tangent half = tangent_at_half_peak(curve, peak, compression);
        EXPECT_TRUE(agrees("initial tangent modulus", initial.modulus, 5e6, 1e-9));
        EXPECT_TRUE(agrees("its Poisson's ratio", initial.poissons_ratio, 0.3, 1e-9));
        EXPECT_EQ(initial.rows, 11) << "the first twentieth";
        EXPECT_EQ(initial.bonds_broken, 1);
        EXPECT_TRUE(agrees("modulus at half the peak", half.modulus, 5e6, 1e-9));
        EXPECT_TRUE(agrees("platens out of balance", platen_out_of_balance(curve, peak), 4.0 / 5e3, 1e-9));
    }
}

TEST(Moduli, OfACurvedCurveDiffer) {
    std::vector<CurveRow> curve;  // σ = E ε (1 - ε/(2ε_p)): slope E at the start, 0.707 E at half the peak
    for (int k = 0; k <= 1000; ++k) {
        CurveRow row;
        row.axial_strain = 1e-6 * k;
        row.axial_stress = 5e6 * row.axial_strain * (1.0 - row.axial_strain / 2e-3);
        curve.push_back(row);
    }
    EXPECT_TRUE(
        agrees("initial tangent modulus", initial_tangent(curve, 1000, true).modulus, 5e6 * (1.0 - 0.025), 1e-3));
    EXPECT_TRUE(agrees("modulus at half the peak", tangent_at_half_peak(curve, 1000, true).modulus,
                       5e6 * std::sqrt(0.5), 1e-2));
}

TEST(Moduli, AverageIsOfTheStraightestPart) {
    std::vector<CurveRow> curve;  // curved up to 30 % of the peak, straight with E to 70 %, flatter beyond
    double strain = 0.0;
    for (int k = 0; k <= 1000; ++k) {
        CurveRow row;
        row.axial_stress = 1e3 * k;
        const double compliance = k < 300 ? 3.0 - 2.0 * k / 300.0 : k < 700 ? 1.0 : 1.0 + (k - 700) / 100.0;
        if (k > 0) strain += 1e3 * compliance / 5e9;
        row.axial_strain = strain;
        row.lateral_strain = 0.2 * strain;
        curve.push_back(row);
    }
    const Tangent average = tangent_of_straightest(curve, 1000, true);
    EXPECT_TRUE(agrees("average modulus", average.modulus, 5e9, 1e-9));
    EXPECT_TRUE(agrees("its Poisson's ratio", average.poissons_ratio, 0.2, 1e-9));
    const Tangent secant = secant_to_half_peak(curve, 1000, true);
    EXPECT_TRUE(agrees("secant modulus", secant.modulus, 500e3 / curve[500].axial_strain, 1e-12));
    EXPECT_TRUE(agrees("ratio of the strains there", secant.poissons_ratio, 0.2, 1e-12));
}

TEST(Moduli, BeyondThePeakAreOfTheFall) {
    std::vector<CurveRow> curve;
    for (int k = 0; k <= 400; ++k) {
        CurveRow row;
        row.axial_strain = 1e-6 * k;
        row.axial_stress = k <= 200 ? 5e9 * row.axial_strain : 1e6 - 10e9 * 1e-6 * (k - 200);
        curve.push_back(row);
    }
    EXPECT_TRUE(agrees("modulus beyond the peak", tangent_beyond_peak(curve, 200, true).modulus, -10e9, 1e-9));
    EXPECT_TRUE(agrees("brittleness index, 1 + E/|M|", brittleness_index(5e9, -10e9), 1.5, 1e-12));
    curve.resize(230);  // falls to 0.71 of the peak
    EXPECT_TRUE(std::isnan(tangent_beyond_peak(curve, 200, true).modulus));
    // Falls to 0.84 of the peak, rises above it, and falls to 0.5 much later: all of it counts as rising.
    std::vector<CurveRow> rises;
    for (const double stress : {0.5, 1.0, 0.84, 0.9, 1.0, 1.1, 1.2, 1.3, 1.35, 0.5}) {
        CurveRow row;
        row.axial_strain = 1e-3 * static_cast<double>(rises.size());
        row.axial_stress = stress;
        rises.push_back(row);
    }
    EXPECT_TRUE(std::isnan(tangent_beyond_peak(rises, 1, true).modulus)) << "it rises";
    EXPECT_TRUE(std::isnan(brittleness_index(5e9, tangent_beyond_peak(rises, 1, true).modulus)));
    const auto drops_at_once = straight_curve(5e6, 1e-3, 0.2, 0.3, 200);
    EXPECT_TRUE(std::isnan(tangent_beyond_peak(drops_at_once, 200, true).modulus)) << "one row only";
}

// It falls with a slope of 2 GPa to nine tenths of the peak, and then with 10 GPa.
TEST(Moduli, BeyondThePeakAreOfTheFallFromNineTenths) {
    std::vector<CurveRow> curve;
    for (int k = 0; k <= 300; ++k) {
        CurveRow row;
        row.axial_strain = 1e-6 * k;
        row.axial_stress = k <= 200 ? 5e3 * k : k <= 250 ? 1e6 - 2e3 * (k - 200) : 0.9e6 - 10e3 * (k - 250);
        curve.push_back(row);
    }
    EXPECT_TRUE(agrees("modulus beyond the peak", tangent_beyond_peak(curve, 200, true).modulus, -10e9, 1e-9));
}

TEST(AreaStrain, IsShorteningLessWidening) {
    CurveRow row;
    row.axial_strain = 3e-3;
    row.lateral_strain = 1e-3;  // wider
    EXPECT_TRUE(agrees("squeezed: the area shrinks", area_strain(row, true), 2e-3, 1e-12));
    row.lateral_strain = -1e-3;  // narrower
    EXPECT_TRUE(agrees("pulled: the area grows", area_strain(row, false), -2e-3, 1e-12));
}

TEST(Moduli, OfTooFewRowsAreNotNumbers) {
    const std::vector<CurveRow> two(2);
    EXPECT_TRUE(std::isnan(initial_tangent(two, 1, true).modulus));
    EXPECT_TRUE(std::isnan(initial_tangent({}, -1, true).modulus));
    EXPECT_TRUE(std::isnan(platen_out_of_balance({}, -1)));
}

/// Rows at strains 1/1024 apart, with a lateral strain of a quarter of the axial one, and counts that differ in every
/// row.
std::vector<CurveRow> by_hand(const std::vector<double>& stress) {
    std::vector<CurveRow> rows;
    for (const double value : stress) {
        const auto k = static_cast<std::int64_t>(rows.size());
        CurveRow row;
        row.axial_strain = static_cast<double>(k) / 1024;
        row.axial_stress = row.stress_top = row.stress_bottom = value;
        row.lateral_strain = row.axial_strain / 4;
        row.bonds_broken = 1 + k * k;
        row.points_sliding = 100 + k;
        row.contacts_gained = 7 + k * k * k;
        rows.push_back(row);
    }
    return rows;
}

std::vector<double> rising(int rows) {
    std::vector<double> stress;
    for (int k = 0; k < rows; ++k) stress.push_back(10.0 * k);
    return stress;
}

TEST(InitialWindow, EndsWithTheRowAtATwentiethOfTheStrainAtPeak) {
    auto stress = rising(41);  // peak in row 40: the window has two rows
    stress[1] = 3;
    stress[2] = 4;
    const Tangent t = initial_tangent(by_hand(stress), 40, true);
    EXPECT_EQ(t.rows, 3);
    EXPECT_EQ(t.strain_to, 2.0 / 1024);
    EXPECT_EQ(t.bonds_broken, 5 - 1);
    EXPECT_EQ(t.points_sliding, 102);
    EXPECT_EQ(t.contacts_gained, 15 - 7);
    EXPECT_DOUBLE_EQ(t.modulus, 2.0 * 1024) << "least squares through 0, 3, 4";
    EXPECT_DOUBLE_EQ(t.poissons_ratio, 0.25);
}

TEST(InitialWindow, OfTwoRowsHasNoModulus) {
    const Tangent t = initial_tangent(by_hand(rising(40)), 39, true);  // the window has 1.95 rows
    EXPECT_EQ(t.rows, 2);
    EXPECT_TRUE(std::isnan(t.modulus));
    EXPECT_TRUE(std::isnan(t.poissons_ratio));
}

TEST(InitialWindow, LooksAtNothingBehindThePeak) {
    auto stress = rising(41);
    for (int k = 0; k < 10; ++k) stress.push_back(0.0);
    const Tangent t = initial_tangent(by_hand(stress), 40, true);
    EXPECT_EQ(t.rows, 3);
    EXPECT_DOUBLE_EQ(t.modulus, 10.0 * 1024);
}

TEST(WindowAtHalfThePeak, ReachesFromTheFirstRowAtTwoFifthsToTheFirstAtThree) {
    // Reaches 4 in row 2, falls, and reaches 6 in row 5; 4 and 6 are 40 % and 60 % of 10.
    const Tangent t = tangent_at_half_peak(by_hand({0, 3, 5, 2, 5.5, 7, 10, 8}), 6, true);
    EXPECT_EQ(t.rows, 4);
    EXPECT_EQ(t.strain_to, 5.0 / 1024);
    EXPECT_EQ(t.bonds_broken, 25 - 4);
    EXPECT_EQ(t.points_sliding, 105);
    EXPECT_EQ(t.contacts_gained, 125 - 8);
    EXPECT_DOUBLE_EQ(t.modulus, 0.95 * 1024) << "least squares through 5, 2, 5.5, 7";
    EXPECT_DOUBLE_EQ(t.poissons_ratio, 0.25);
}

TEST(WindowAtHalfThePeak, HoldsTheRowsThatMeetItsLimits) {
    const Tangent at = tangent_at_half_peak(by_hand({0, 4, 5, 6, 10}), 4, true);
    EXPECT_EQ(at.rows, 3);
    EXPECT_EQ(at.strain_to, 3.0 / 1024);
    EXPECT_EQ(tangent_at_half_peak(by_hand({0, 3.9, 5, 5.9, 7, 10}), 5, true).rows, 3);
}

TEST(PoissonsRatio, IsOfNarrowingInTension) {
    EXPECT_DOUBLE_EQ(initial_tangent(by_hand(rising(41)), 40, false).poissons_ratio, -0.25);
}

TEST(PlatensOutOfBalance, IsTheLargestDifferenceUpToThePeak) {
    auto rows = by_hand({0, 5, 8, 10, 2});
    rows[1].stress_top = 4;
    rows[1].stress_bottom = 6;
    rows[3].stress_top = 11.5;
    rows[3].stress_bottom = 8.5;
    EXPECT_DOUBLE_EQ(platen_out_of_balance(rows, 3), 0.3);
    rows[2].stress_top = 6;
    rows[2].stress_bottom = 10;
    EXPECT_DOUBLE_EQ(platen_out_of_balance(rows, 3), 0.4) << "absolute value";
    rows[4].stress_top = 100;
    EXPECT_DOUBLE_EQ(platen_out_of_balance(rows, 3), 0.4) << "not after the peak";
}

}  // namespace
}  // namespace crackle
