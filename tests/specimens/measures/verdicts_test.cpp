// SPDX-License-Identifier: GPL-3.0-or-later
// Tests verdicts on generated cracks, each true for one specimen and false for another, and values of a shear box from
// a generated curve.

#include "specimens/measures/verdicts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "specimens/measures/shear_box.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

/// Particles on a grid with spacing 1, and cracks between neighbours.
class Cracked {
  public:
    Cracked(LoadingKind kind, int columns, int rows) : columns_(columns) {
        setup.apparatus.kind = kind;
        setup.apparatus.uniaxial = kind == LoadingKind::compression || kind == LoadingKind::tension;
        setup.apparatus.compression = kind != LoadingKind::tension && kind != LoadingKind::direct_shear;
        setup.specimen.width = columns;
        setup.specimen.height = rows;
        setup.specimen.area = columns * rows;
        setup.specimen.particles = static_cast<std::int64_t>(columns) * rows;
        setup.specimen.middle = 0.5 * (columns - 1);
        setup.specimen.middle_height = 0.5 * (rows - 1);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                setup.bonds.start.push_back({static_cast<double>(column), static_cast<double>(row), 0.0});
        setup.apparatus.bottom = static_cast<BodyIndex>(setup.bonds.start.size());
        setup.apparatus.top = setup.apparatus.bottom + 1;
        setup.bonds.start.resize(setup.bonds.start.size() + 2);
        setup.apparatus.parts = {{setup.apparatus.bottom, 2}, {setup.apparatus.top, 2}};
    }
    BodyIndex at(int column, int row) const { return static_cast<BodyIndex>(row * columns_ + column); }
    void break_between(BodyIndex a, BodyIndex b, double time = 1.0, double energy = 1.0) {
        setup.bonds.points.push_back(PointKind::circle_circle, ContactPoint{a, b, 0, 0});
        Crack crack;
        crack.time = time;
        crack.energy = energy;
        crack.bond = static_cast<PointIndex>(setup.bonds.points.size() - 1);
        history.cracks.push_back(crack);
    }
    /// Breaks a column from its right neighbour along a zigzag, so that breaks share particles.
    void split(int column, int from, int to) {
        for (int row = from; row <= to; ++row) {
            break_between(at(column, row), at(column + 1, row));
            if (row < to) break_between(at(column, row + 1), at(column + 1, row));
        }
    }
    std::vector<Verdict> verdicts(bool failed = true) const {
        // The stress drops by 2 % at time 2.
        std::vector<CurveRow> rows(4);
        const double stress[] = {0.0, 100.0, 98.0, 10.0};
        for (std::size_t k = 0; k < rows.size(); ++k) {
            rows[k].time = static_cast<double>(k);
            rows[k].axial_stress = stress[k];
        }
        return verdicts_on(setup, rows, history, failed);
    }

    TestSetup setup;
    ContactHistory history;

  private:
    int columns_;
};

TEST(Verdicts, DiscThatSplitsAlongItsLoadIsValid) {
    Cracked disc(LoadingKind::brazilian, 21, 21);
    disc.split(10, 3, 17);
    for (const Verdict& verdict : disc.verdicts())
        EXPECT_EQ(verdict.holds, true) << verdict.claim << ": " << verdict.found;
}

TEST(Verdicts, DiscThatIsCrushedAtBothJawsIsNot) {
    Cracked disc(LoadingKind::brazilian, 21, 21);
    disc.split(10, 0, 2);  // the mean position of both splits is the centre
    disc.split(10, 18, 20);
    for (const Verdict& verdict : disc.verdicts())
        EXPECT_EQ(verdict.holds, false) << verdict.claim << ": " << verdict.found;
}

TEST(Verdicts, BreaksAfterTheFirstDropDoNotCountAgainstADisc) {
    Cracked disc(LoadingKind::brazilian, 21, 21);
    disc.break_between(disc.at(10, 10), disc.at(11, 10), 1.0);
    disc.break_between(disc.at(10, 0), disc.at(11, 0), 2.5, 1000.0);
    const auto verdicts = disc.verdicts();
    EXPECT_EQ(verdicts[0].holds, true) << verdicts[0].found;
    EXPECT_EQ(verdicts[1].holds, true) << verdicts[1].found;
}

TEST(Verdicts, SlantedCrackOfADiscIsNotASplit) {
    Cracked disc(LoadingKind::brazilian, 21, 21);
    for (int k = 4; k < 16; ++k) {
        disc.break_between(disc.at(k, k), disc.at(k + 1, k));
        disc.break_between(disc.at(k + 1, k), disc.at(k + 1, k + 1));
    }
    EXPECT_EQ(disc.verdicts()[2].holds, false) << disc.verdicts()[2].found;
    EXPECT_FALSE(disc.verdicts(false)[2].holds.has_value());  // not decided yet
}

TEST(Verdicts, BeamBreaksAtMidspanOrNot) {
    Cracked middle(LoadingKind::bending, 81, 21), end(LoadingKind::bending, 81, 21);
    middle.split(40, 0, 15);
    end.split(70, 0, 15);
    EXPECT_EQ(middle.verdicts()[0].holds, true) << middle.verdicts()[0].found;
    EXPECT_EQ(end.verdicts()[0].holds, false) << end.verdicts()[0].found;
}

TEST(Verdicts, ACrackAtThirtyDegreesIsNoSplitAndOneAtTenIs) {
    for (const auto& [rise, valid] :
         {std::pair{std::tan(std::numbers::pi / 6.0), false}, {std::tan(std::numbers::pi / 18.0), true}}) {
        Cracked disc(LoadingKind::brazilian, 21, 21);
        const auto column = [&](int row) { return static_cast<int>(std::lround(10.0 + rise * (row - 10))); };
        for (int row = 3; row <= 17; ++row) {
            const int at = column(row);
            disc.break_between(disc.at(at, row), disc.at(at + 1, row));
            if (row < 17 && column(row + 1) != at) disc.break_between(disc.at(at + 1, row), disc.at(at + 1, row + 1));
        }
        const Verdict split = disc.verdicts()[2];
        EXPECT_EQ(split.holds, valid) << split.found;
    }
}

TEST(Verdicts, MidspanIsAQuarterOfTheHeightToEitherSide) {
    Cracked near(LoadingKind::bending, 81, 21), far(LoadingKind::bending, 81, 21);
    near.split(44, 0, 15);  // splits at 4.5 from the middle; the limit is 5.25
    far.split(47, 0, 15);   // splits at 7.5 from the middle
    EXPECT_EQ(near.verdicts()[0].holds, true) << near.verdicts()[0].found;
    EXPECT_EQ(far.verdicts()[0].holds, false) << far.verdicts()[0].found;
}

TEST(Verdicts, ACrackSpansHalfOfWhatTheNotchHasLeft) {
    Cracked beam(LoadingKind::bending, 81, 21);
    beam.split(40, 12, 18);  // broken over 6 of a height of 21
    EXPECT_EQ(beam.verdicts()[0].holds, false) << beam.verdicts()[0].found;
    beam.setup.specimen.notch = 11.0;  // 10 are left above the notch
    EXPECT_EQ(beam.verdicts()[0].holds, true) << beam.verdicts()[0].found;
}

TEST(Verdicts, BoxShearsAlongItsGapOrNot) {
    Cracked along(LoadingKind::direct_shear, 41, 21), across(LoadingKind::direct_shear, 41, 21);
    for (int k = 0; k < 40; ++k) along.break_between(along.at(k, 10), along.at(k, 11));
    for (int k = 0; k < 20; ++k) across.break_between(across.at(k, k), across.at(k + 1, k));
    EXPECT_EQ(along.verdicts()[0].holds, true) << along.verdicts()[0].found;
    EXPECT_EQ(across.verdicts()[0].holds, false) << across.verdicts()[0].found;
}

TEST(Verdicts, SpecimenBetweenPlatensIsWideEnoughAndPartsInTheMiddleOrNot) {
    Cracked good(LoadingKind::tension, 20, 40), bad(LoadingKind::tension, 10, 40);
    good.break_between(good.at(5, 20), good.at(5, 21));
    bad.break_between(bad.at(5, 0), bad.setup.apparatus.bottom);
    for (const Verdict& verdict : good.verdicts())
        EXPECT_EQ(verdict.holds, true) << verdict.claim << ": " << verdict.found;
    for (const Verdict& verdict : bad.verdicts())
        EXPECT_EQ(verdict.holds, false) << verdict.claim << ": " << verdict.found;
    EXPECT_FALSE(Cracked(LoadingKind::tension, 20, 40).verdicts()[1].holds.has_value());
}

TEST(Verdicts, EachClaimThatDoesNotHoldHasASentence) {
    EXPECT_EQ(broken_claim("the specimen is at least 20 particles wide", "12.3 particles"),
              "the specimen is 12.3 particles wide; at least 20 are needed");
    EXPECT_EQ(broken_claim("the moon is round", "a cube"), "condition not met: the moon is round: a cube")
        << "summary of another version";
    std::size_t claims = 0;
    for (const LoadingKind kind : {LoadingKind::compression, LoadingKind::tension, LoadingKind::brazilian,
                                   LoadingKind::bending, LoadingKind::direct_shear}) {
        for (const Verdict& verdict : Cracked(kind, 21, 21).verdicts()) {
            const std::string sentence = broken_claim(verdict.claim, "<found>");
            EXPECT_EQ(sentence.find("it does not hold"), std::string::npos) << sentence;
            EXPECT_NE(sentence.find("<found>"), std::string::npos) << sentence;
            ++claims;
        }
    }
    EXPECT_EQ(claims, 9U);
}

TEST(ShearBox, ResidualAndDilationAreThoseOfTheCurve) {
    // The stress has its peak in row 50 and is then 3; the rise has a slope of tan 12 degrees.
    std::vector<CurveRow> rows(101);
    const double slope = std::tan(12.0 * 3.14159265358979 / 180.0), height = 2.0, length = 3.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].axial_strain = 1e-4 * static_cast<double>(k);
        rows[k].axial_stress = k == 50 ? 10.0 : k > 50 ? 3.0 : 0.1 * static_cast<double>(k);
        rows[k].lateral_strain = slope * rows[k].axial_strain * length / height;
    }
    const ShearBoxFigures figures = measure_shear_box(rows, 50, true, height, length);
    EXPECT_TRUE(agrees("residual stress", figures.residual, 3.0, 1e-12));
    EXPECT_TRUE(agrees("dilation angle", figures.dilation_at_peak, 12.0, 1e-9));
    for (std::size_t k = 80; k < 90; ++k) rows[k].axial_stress = 5.0;
    EXPECT_TRUE(agrees("of the last tenth of the strain alone",
                       measure_shear_box(rows, 50, true, height, length).residual, 3.0, 1e-12));
    EXPECT_TRUE(std::isnan(measure_shear_box(rows, 50, false, height, length).residual));
    EXPECT_TRUE(std::isnan(measure_shear_box({}, -1, true, height, length).dilation_at_peak));
}

}  // namespace
}  // namespace crackle
