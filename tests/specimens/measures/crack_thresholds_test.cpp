// SPDX-License-Identifier: GPL-3.0-or-later
// Tests crack initiation and damage for curves whose cracks begin and join at given stresses.

#include "specimens/measures/crack_thresholds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"

namespace crackle::crack_thresholds_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double modulus = 50e9, ratio = 0.25, peak = 100e6, begin = 45e6, join = 80e6;
constexpr int rows_to_peak = 1000;
constexpr double spacing = peak / rows_to_peak;

/// σ = E ε up to the peak. Beyond `begin` cracks open and widen the specimen by k (σ - begin)², with k such that the
/// area is smallest at `join`; every row there has a break. @param noise uniform noise of the lateral strain, m/m
std::vector<CurveRow> cracking_curve(double noise = 0.0) {
    std::mt19937_64 generator(5);
    const double k = (1.0 - ratio) / (2.0 * modulus * (join - begin));
    std::vector<CurveRow> rows;
    for (int n = 0; n <= rows_to_peak + 200; ++n) {
        CurveRow row;
        row.axial_strain = n * spacing / modulus;
        row.axial_stress = n <= rows_to_peak ? n * spacing : 0.4 * peak;
        const double open = std::max(0.0, row.axial_stress - begin);
        row.lateral_strain = ratio * row.axial_strain + k * open * open + uniform_number(generator, -noise, noise);
        row.bonds_broken = std::max(0, n - static_cast<int>(begin / spacing));
        rows.push_back(row);
    }
    return rows;
}

CrackThresholds of(const std::vector<CurveRow>& rows) {
    return find_crack_thresholds(rows, rows_to_peak, modulus, ratio);
}

TEST(CrackThresholds, AreWhereCracksBeginAndJoin) {
    const CrackThresholds found = of(cracking_curve());
    EXPECT_TRUE(within("crack damage: largest area strain, Pa", found.damage, join, spacing));
    EXPECT_TRUE(agrees("axial strain there", found.damage_strain, join / modulus, spacing / join));
    EXPECT_TRUE(within("1 % of the 550 breaks up to the peak, the sixth, Pa", found.first_percent, begin + 6 * spacing,
                       1e-3 * spacing));
    // The number of breaks is evaluated at 200 stresses up to 0.8 of the peak.
    EXPECT_TRUE(within("break of the count, Pa", found.count_break, begin, 0.8 * peak / 200.0));
    EXPECT_LE(found.low, begin + 0.8 * peak / 200.0);
    EXPECT_GE(found.high, begin - 0.8 * peak / 200.0);
    // The slope of the lateral strain is that of its chord.
    const double farthest = begin + (join - begin) * (join - begin) / (2.0 * join);
    EXPECT_TRUE(within("lateral strain farthest from its chord, Pa", found.lateral_strain, farthest, spacing));
    // Without noise, this is the first row opened by more than round-off, 1e-16 of 1e-3.
    EXPECT_TRUE(within("crack strain, Pa", found.crack_strain, begin, 2.0 * spacing));
    EXPECT_TRUE(within("largest less smallest, Pa", found.spread(), farthest - begin, 3.0 * spacing));
}

TEST(CrackThresholds, OfNoisyStrainsAreWhereTheyLeaveTheNoise) {
    constexpr double noise = 2e-6;
    const CrackThresholds found = of(cracking_curve(noise));
    const double k = (1.0 - ratio) / (2.0 * modulus * (join - begin)), deviation = noise / std::sqrt(3.0);
    // In the last row within the band, the opening is the band plus or minus the noise itself.
    const auto opened = [&](double by) { return begin + std::sqrt(by / k); };
    EXPECT_GE(found.crack_strain, opened(3.0 * deviation - noise));
    EXPECT_LE(found.crack_strain, opened(3.5 * deviation + noise));
    EXPECT_GT(found.crack_strain, begin);
}

/// Rows alternate by ±a between a tenth and a quarter of the peak, and are exact otherwise. Of the 250 quiet rows 150
/// alternate, so the standard deviation is a sqrt(150/249). The opening exceeds three of these at sqrt(3 deviations/k).
TEST(CrackThresholds, NoiseIsThatOfTheRowsUpToAQuarterOfThePeak) {
    constexpr double a = 2e-6;
    std::vector<CurveRow> rows = cracking_curve();
    for (std::size_t n = 100; n < 250; ++n) rows[n].lateral_strain += n % 2 == 0 ? a : -a;
    const double k = (1.0 - ratio) / (2.0 * modulus * (join - begin)), deviation = a * std::sqrt(150.0 / 249.0);
    EXPECT_TRUE(
        within("crack strain, Pa", of(rows).crack_strain, begin + std::sqrt(3.0 * deviation / k), 2.0 * spacing));
}

TEST(CrackThresholds, NoiseIsNotKnownOfFewerThanTenRows) {
    for (const auto& [stride, known] : {std::pair{20, true}, {40, false}}) {  // 13 and 7 quiet rows
        std::vector<CurveRow> few;
        const std::vector<CurveRow> rows = cracking_curve();
        for (std::size_t n = 0; n <= rows_to_peak; n += static_cast<std::size_t>(stride)) few.push_back(rows[n]);
        const CrackThresholds found =
            find_crack_thresholds(few, static_cast<std::int64_t>(few.size()) - 1, modulus, ratio);
        EXPECT_EQ(std::isfinite(found.crack_strain), known) << stride;
        EXPECT_TRUE(std::isfinite(found.damage));
    }
}

TEST(CrackThresholds, DropsOnTheWayDoNotCountTwice) {
    std::vector<CurveRow> rows = cracking_curve();
    for (int n = 600; n < 620; ++n) rows[static_cast<std::size_t>(n)].axial_stress *= 0.7;
    EXPECT_TRUE(within("break of the count, Pa", of(rows).count_break, begin, 0.8 * peak / 100.0));
}

// Near the peak cracks join, and their number grows much faster than where they begin.
TEST(CrackThresholds, BreaksBeyondFourFifthsOfThePeakDoNotMoveTheBreakOfTheCount) {
    std::vector<CurveRow> rows = cracking_curve();
    for (std::size_t n = 850; n < rows.size(); ++n) rows[n].bonds_broken += 100 * static_cast<int>(n - 850);
    EXPECT_TRUE(within("break of the count, Pa", of(rows).count_break, begin, 0.8 * peak / 200.0));
}

TEST(CrackThresholds, ThatCannotBeReadAreNotNumbers) {
    std::vector<CurveRow> rows = cracking_curve();
    for (CurveRow& row : rows) row.lateral_strain = std::nan("");
    const CrackThresholds no_sides = of(rows);
    EXPECT_TRUE(std::isnan(no_sides.damage) && std::isnan(no_sides.crack_strain) &&
                std::isnan(no_sides.lateral_strain));
    EXPECT_TRUE(std::isfinite(no_sides.first_percent) && std::isfinite(no_sides.count_break));
    for (CurveRow& row : rows) row.bonds_broken = 0;
    const CrackThresholds intact = of(rows);
    EXPECT_TRUE(std::isnan(intact.first_percent) && std::isnan(intact.count_break) && std::isnan(intact.spread()));
    EXPECT_TRUE(std::isnan(find_crack_thresholds(rows, -1, modulus, ratio).damage)) << "no peak";
    const CrackThresholds no_solve = find_crack_thresholds(cracking_curve(), rows_to_peak, std::nan(""), ratio);
    EXPECT_TRUE(std::isnan(no_solve.crack_strain) && std::isfinite(no_solve.damage));
}

}  // namespace
}  // namespace crackle::crack_thresholds_test
