// SPDX-License-Identifier: GPL-3.0-or-later
// Tests peak, largest stress and failure of curves written by hand: the exact row of each.

#include "specimens/observers/peak_and_failure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "specimens/observers/curve.hpp"
#include "tests/specimens/measures/straight_curve.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::straight_curve;

FailureTracker tracked(const std::vector<CurveRow>& curve, double share = 0.5) {
    FailureTracker tracker;
    tracker.share_of_peak = share;
    for (std::size_t k = 0; k < curve.size() && !tracker.collapsed; ++k) {
        tracker.update(static_cast<std::int64_t>(k), curve[k].axial_strain, curve[k].axial_stress);
    }
    return tracker;
}

TEST(Failure, IsATenthOfThePeakStrainBelowHalfThePeak) {
    const auto curve = straight_curve(5e6, 1e-3, 0.49, 0.3, 100);
    FailureTracker tracker;
    std::size_t row = 0;
    while (!tracker.collapsed) {
        ASSERT_LT(row, curve.size());
        tracker.update(static_cast<std::int64_t>(row), curve[row].axial_strain, curve[row].axial_stress);
        ++row;
    }
    EXPECT_TRUE(agrees("peak stress", tracker.peak_stress, 5e3, 1e-12));
    EXPECT_TRUE(agrees("peak strain", tracker.peak_strain, 1e-3, 1e-12));
    EXPECT_NEAR(static_cast<double>(row - 1), 111.0, 1.0) << "below from row 101, for ten rows";
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
    EXPECT_FALSE(tracked(straight_curve(5e6, 1e-3, 0.51, 0.3, 100)).collapsed);
    EXPECT_TRUE(tracked(straight_curve(5e6, 1e-3, 0.51, 0.3, 100), 0.6).collapsed) << "the share can be set";
    auto curve = straight_curve(5e6, 1e-3, 0.2, 0.3, 100);
    for (std::size_t k = 105; k < curve.size(); k += 5) curve[k].axial_stress = 3e3;  // above half every five rows
    EXPECT_FALSE(tracked(curve).collapsed);
}

/// Passes stresses at strains 1/1024 apart. @return row at which the test ends by failure; -1 if it does not
std::int64_t failing_row(FailureTracker& tracker, const std::vector<double>& stress) {
    for (std::size_t row = 0; row < stress.size(); ++row) {
        tracker.update(static_cast<std::int64_t>(row), static_cast<double>(row) / 1024, stress[row]);
        if (tracker.collapsed) return static_cast<std::int64_t>(row);
    }
    return -1;
}

/// Passes all rows to the tracker. @return row at which the peak is known; -1 if it is not
std::int64_t known_row(FailureTracker& tracker, const std::vector<double>& stress) {
    std::int64_t known = -1;
    for (std::size_t row = 0; row < stress.size(); ++row) {
        tracker.update(static_cast<std::int64_t>(row), static_cast<double>(row) / 1024, stress[row]);
        if (tracker.failed && known < 0) known = static_cast<std::int64_t>(row);
    }
    return known;
}

/// Appends `value` to a list of stresses `times` times.
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
    EXPECT_EQ(failing_row(pulled, then({-1, -2, -3}, -4.0, 40)), -1) << "negative in the direction of the test";
    EXPECT_EQ(pulled.peak_row, -1);
}

TEST(Failure, NegativeStressIsBelowEveryShare) {
    FailureTracker tracker;
    EXPECT_EQ(failing_row(tracker, then({0, 8}, -1.0, 20)), 12) << "below from row 2, ten rows later";
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
    stress.push_back(4.0);                               // equal to half the peak, not below
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

FailureTracker by_a_tenth() {
    FailureTracker tracker;
    tracker.strength_drop = 0.1;
    return tracker;
}

TEST(Strength, IsTheFirstMaximumThatADropFollows) {
    FailureTracker tracker = by_a_tenth();
    EXPECT_EQ(known_row(tracker, then({0, 8}, 7.0, 20)), 12) << "below 7.2 from row 2, ten rows later";
    EXPECT_EQ(tracker.peak_row, 1);
    EXPECT_FALSE(tracker.collapsed) << "above half the peak";
    EXPECT_FALSE(tracker.larger_after_peak());
}

TEST(Strength, IsNotALaterPeakOfRubble) {
    FailureTracker tracker = by_a_tenth();
    std::vector<double> stress = then({0, 8}, 6.0, 11);  // rows 2 to 12
    stress.insert(stress.end(), {9.0, 12.0, 16.0});
    std::vector<bool> new_peak;
    for (const double value : then(stress, 7.0, 30)) {
        const auto row = static_cast<std::int64_t>(new_peak.size());
        new_peak.push_back(tracker.update(row, static_cast<double>(row) / 1024, value));
        EXPECT_EQ(tracker.failed, row >= 12) << row;
        EXPECT_EQ(tracker.collapsed, row >= 26) << row << ": below half the largest from row 16";
    }
    EXPECT_EQ(tracker.peak_row, 1);
    EXPECT_EQ(tracker.peak_stress, 8.0);
    EXPECT_EQ(tracker.peak_strain, 1.0 / 1024);
    EXPECT_EQ(tracker.largest_row, 15);
    EXPECT_EQ(tracker.largest_stress, 16.0);
    EXPECT_EQ(tracker.strain_at_largest, 15.0 / 1024);
    EXPECT_TRUE(tracker.larger_after_peak());
    EXPECT_EQ(std::count(new_peak.begin(), new_peak.end(), true), 1) << "no picture after the failure";
}

TEST(Strength, OfAPlateauIsItsFirstRow) {
    FailureTracker flat = by_a_tenth(), falling = by_a_tenth();
    EXPECT_EQ(known_row(flat, then({0, 8, 8, 8}, 7.5, 40)), -1) << "the drop is less than a tenth";
    EXPECT_EQ(known_row(falling, then({0, 8, 8, 8}, 7.0, 40)), 4 + 10);
    EXPECT_EQ(falling.peak_row, 1);
}

TEST(Strength, ADropThatRecoversTooSoonCountsForNothing) {
    FailureTracker higher = by_a_tenth(), lower = by_a_tenth();
    std::vector<double> stress = then({0, 8}, 5.0, 10);  // rows 2 to 11: nine intervals
    stress.push_back(9.0);
    EXPECT_EQ(known_row(higher, then(stress, 7.0, 20)), 13 + 10);
    EXPECT_EQ(higher.peak_row, 12);
    stress.back() = 7.5;  // again within a tenth of the peak
    EXPECT_EQ(known_row(lower, then(stress, 7.0, 20)), 13 + 10);
    EXPECT_EQ(lower.peak_row, 1);
}

TEST(Strength, ADropOfExactlyTheShareIsNotBelowIt) {
    FailureTracker at = by_a_tenth(), below = by_a_tenth();
    at.strength_drop = below.strength_drop = 0.125;
    EXPECT_EQ(known_row(at, then({0, 8}, 7.0, 40)), -1);
    EXPECT_EQ(known_row(below, then({0, 8}, 6.999, 40)), 12);
}

TEST(Strength, WithoutADropIsTheLargestStressSoFar) {
    FailureTracker tracker = by_a_tenth();
    EXPECT_EQ(known_row(tracker, {0, 1, 2, 3, 2.9, 4, 5}), -1);
    EXPECT_EQ(tracker.peak_row, 6);
    EXPECT_EQ(tracker.largest_row, 6);
}

TEST(Strength, NeedsATenthOfTheStrainAtItsPeak) {
    std::vector<double> rise;
    for (int row = 0; row <= 205; ++row) rise.push_back(row);
    FailureTracker tracker = by_a_tenth();
    EXPECT_EQ(known_row(tracker, then(rise, 150.0, 100)), 206 + 21) << "20.5 rows of strain decide";
}

TEST(Strength, IsTheLargestStressWhereTheTestEndsBeforeSuchADrop) {
    FailureTracker tracker = by_a_tenth();
    tracker.strength_drop = 0.75;
    EXPECT_EQ(known_row(tracker, then({0, 8}, 3.0, 20)), 12) << "below half the peak";
    EXPECT_TRUE(tracker.collapsed);
    EXPECT_EQ(tracker.peak_row, 1);
}

/// Stress is positive in the direction of loading: after tension failure it falls to 0 and oscillates below.
TEST(Strength, OfASpecimenPulledApart) {
    FailureTracker tracker = by_a_tenth();
    std::vector<double> stress{0, 4, 8, 0, -1};
    EXPECT_EQ(known_row(tracker, then(stress, 0.01, 20)), 3 + 10);
    EXPECT_TRUE(tracker.collapsed);
    EXPECT_EQ(tracker.peak_row, 2);
    EXPECT_EQ(tracker.largest_row, 2);
}

TEST(Failure, EndsByTheWayGoneWhereStressAndStrainFallTogether) {
    FailureTracker tracker;
    // Up to row 1000, then back along the same line: class II.
    const auto at = [](int row) { return (row <= 1000 ? row : 2000 - row) / 1024.0; };
    int row = 0;
    for (; row < 2000 && !tracker.collapsed; ++row) tracker.update(row, at(row), row / 1024.0, at(row));
    EXPECT_EQ(tracker.peak_row, 1000);
    EXPECT_EQ(tracker.peak_strain, at(1000));
    // Below half the peak from row 1501 on, for a tenth of the strain at the peak, 100 rows.
    EXPECT_EQ(row - 1, 1601);
}

}  // namespace
}  // namespace crackle
