// SPDX-License-Identifier: GPL-3.0-or-later
// Peak and failure of curves written by hand: the exact row of each.

#include "specimens/observers/peak_and_failure.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "specimens/observers/curve.hpp"
#include "tests/specimens/observers/straight_curve.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::straight_curve;

FailureTracker tracked(const std::vector<CurveRow>& curve, double share = 0.5) {
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
    EXPECT_FALSE(tracked(straight_curve(5e6, 1e-3, 0.51, 0.3, 100)).failed);
    EXPECT_TRUE(tracked(straight_curve(5e6, 1e-3, 0.51, 0.3, 100), 0.6).failed) << "the share is settable";
    auto curve = straight_curve(5e6, 1e-3, 0.2, 0.3, 100);
    for (std::size_t k = 105; k < curve.size(); k += 5) curve[k].axial_stress = 3e3;  // back above half every five rows
    EXPECT_FALSE(tracked(curve).failed);
}

/// Stresses of rows 1/1024 of strain apart. @return row at which failure is found, -1 if it is not
std::int64_t failing_row(FailureTracker& tracker, const std::vector<double>& stress) {
    for (std::size_t row = 0; row < stress.size(); ++row) {
        tracker.update(static_cast<std::int64_t>(row), static_cast<double>(row) / 1024, stress[row]);
        if (tracker.failed) return static_cast<std::int64_t>(row);
    }
    return -1;
}

/// The beginning, then `value` so many times.
std::vector<double> then(std::vector<double> stress, double value, int times) {
    stress.insert(stress.end(), static_cast<std::size_t>(times), value);
    return stress;
}

TEST(Failure, PeakOfEqualRowsIsTheFirst) {
    FailureTracker tracker;
    EXPECT_EQ(failing_row(tracker, {0, 4, 8, 8, 8, 5}), -1);
    EXPECT_EQ(tracker.peak_row, 2);
    EXPECT_EQ(tracker.peak_stress, 8.0);
    EXPECT_EQ(tracker.peak_strain, 2.0 / 1024);
}

TEST(Failure, PeakMayBeTheLastRow) {
    FailureTracker tracker;
    EXPECT_EQ(failing_row(tracker, {0, 1, 2, 3, 4, 5}), -1);
    EXPECT_EQ(tracker.peak_row, 5);
}

TEST(Failure, RowsWithoutStressHaveNoPeak) {
    FailureTracker zeros, begins_late, pulled;
    EXPECT_EQ(failing_row(zeros, then({}, 0.0, 40)), -1);
    EXPECT_EQ(zeros.peak_row, -1);
    EXPECT_EQ(failing_row(begins_late, {0, 0, 0, 2}), -1);
    EXPECT_EQ(begins_late.peak_row, 3);
    EXPECT_EQ(failing_row(pulled, then({-1, -2, -3}, -4.0, 40)), -1) << "negative in the sense of the test";
    EXPECT_EQ(pulled.peak_row, -1);
}

TEST(Failure, NegativeStressIsBelowEveryShare) {
    FailureTracker tracker;
    EXPECT_EQ(failing_row(tracker, then({0, 8}, -1.0, 20)), 12) << "below from row 2 on, ten rows later";
}

TEST(Failure, NeedsTenRowsAndATenthOfTheStrainAtPeak) {
    FailureTracker early, late;
    EXPECT_EQ(failing_row(early, then({0, 8}, 3.0, 20)), 12) << "ten rows decide";
    std::vector<double> rise;
    for (int row = 0; row <= 205; ++row) rise.push_back(row);
    EXPECT_EQ(failing_row(late, then(rise, 50.0, 100)), 206 + 21) << "20.5 rows of strain decide";
    EXPECT_EQ(late.peak_row, 205);
}

TEST(Failure, BeginsAgainAfterARowAtTheShare) {
    FailureTracker tracker;
    std::vector<double> stress = then({0, 8}, 3.0, 10);  // rows 2 to 11
    stress.push_back(4.0);                               // half the peak is not below it
    EXPECT_EQ(failing_row(tracker, then(stress, 3.0, 30)), 13 + 10);
}

TEST(Failure, BeginsAgainAfterAHigherPeak) {
    FailureTracker tracker;
    std::vector<double> stress = then({0, 8}, 3.0, 9);  // rows 2 to 10
    stress.push_back(16.0);
    EXPECT_EQ(failing_row(tracker, then(stress, 7.0, 30)), 12 + 10);
    EXPECT_EQ(tracker.peak_row, 11);
    EXPECT_EQ(tracker.peak_stress, 16.0);
}

TEST(Failure, ShareIsAsSet) {
    FailureTracker at, below;
    at.share_of_peak = below.share_of_peak = 0.75;
    EXPECT_EQ(failing_row(at, then({0, 8}, 6.0, 40)), -1);
    EXPECT_EQ(failing_row(below, then({0, 8}, 5.5, 40)), 12);
}

}  // namespace
}  // namespace crackle
