// SPDX-License-Identifier: GPL-3.0-or-later
// What is read off a curve: peak, failure, moduli, platen balance, on curves whose answers are known.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "specimens/observers/curve_analysis.hpp"
#include "specimens/observers/failure.hpp"
#include "specimens/results/sha256.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

/// σ = E ε up to the peak, then a drop to a share of it; lateral strain = ν ε.
std::vector<CurveRow> straight_curve(double modulus, double peak_strain, double share_after, double poissons_ratio,
                                     int rows) {
    std::vector<CurveRow> curve;
    for (int k = 0; k <= 2 * rows; ++k) {
        CurveRow row;
        row.axial_strain = peak_strain * k / rows;
        row.axial_stress = k <= rows ? modulus * row.axial_strain : share_after * modulus * peak_strain;
        row.stress_top = row.axial_stress + 2.0;
        row.stress_bottom = row.axial_stress - 2.0;
        row.lateral_strain = poissons_ratio * row.axial_strain;
        row.bonds_broken = k / 10;
        curve.push_back(row);
    }
    return curve;
}

FailureTracker judge(const std::vector<CurveRow>& curve, double share = 0.5) {
    FailureTracker tracker;
    tracker.share_of_peak = share;
    for (std::size_t k = 0; k < curve.size() && !tracker.failed; ++k) {
        tracker.update(static_cast<std::int64_t>(k), curve[k].axial_strain, curve[k].axial_stress);
    }
    return tracker;
}

TEST(Failure, IsATenthOfThePeakStrainBelowHalfThePeak) {
    const auto curve = straight_curve(5e6, 1e-3, 0.49, 0.3, 100);
    FailureTracker tracker;
    std::size_t row = 0;
    while (!tracker.failed) {
        ASSERT_LT(row, curve.size());
        tracker.update(static_cast<std::int64_t>(row), curve[row].axial_strain, curve[row].axial_stress);
        ++row;
    }
    EXPECT_TRUE(agrees("peak stress", tracker.peak_stress, 5e3, 1e-12));
    EXPECT_TRUE(agrees("peak strain", tracker.peak_strain, 1e-3, 1e-12));
    EXPECT_NEAR(static_cast<double>(row - 1), 111.0, 1.0) << "below from row 101 on, for ten rows";
}

TEST(Failure, DoesNotComeFromTheFirstTrembling) {
    FailureTracker tracker;
    const std::vector<double> stress{3.0, 1.0, 0.5, 1.2, 0.4, 0.2, 2.0, 50.0, 100.0, 150.0, 200.0};
    for (std::size_t row = 0; row < stress.size(); ++row) {
        tracker.update(static_cast<std::int64_t>(row), 1e-6 * static_cast<double>(row), stress[row]);
    }
    EXPECT_FALSE(tracker.failed);
    EXPECT_EQ(tracker.peak_row, 10);
}

TEST(Failure, DoesNotComeAboveTheShareNorAfterARecovery) {
    EXPECT_FALSE(judge(straight_curve(5e6, 1e-3, 0.51, 0.3, 100)).failed);
    EXPECT_TRUE(judge(straight_curve(5e6, 1e-3, 0.51, 0.3, 100), 0.6).failed) << "the share is settable";
    auto curve = straight_curve(5e6, 1e-3, 0.2, 0.3, 100);
    for (std::size_t k = 105; k < curve.size(); k += 5) curve[k].axial_stress = 3e3;  // back above half every five rows
    EXPECT_FALSE(judge(curve).failed);
}

TEST(Moduli, OfAStraightCurveAreItsSlope) {
    for (const bool compression : {true, false}) {
        const auto curve = straight_curve(5e6, 1e-3, 0.2, compression ? 0.3 : -0.3, 200);
        const std::int64_t peak = judge(curve).peak_row;
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

TEST(Moduli, OfTooFewRowsAreNotNumbers) {
    const std::vector<CurveRow> two(2);
    EXPECT_TRUE(std::isnan(initial_tangent(two, 1, true).modulus));
    EXPECT_TRUE(std::isnan(initial_tangent({}, -1, true).modulus));
    EXPECT_TRUE(std::isnan(platen_out_of_balance({}, -1)));
}

TEST(Sha256, MatchesTheExamplesOfItsStandard) {  // FIPS 180-4
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace crackle
