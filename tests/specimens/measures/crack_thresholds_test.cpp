// SPDX-License-Identifier: GPL-3.0-or-later
// Tests crack initiation and damage for curves whose cracks begin and join at given stresses.

#include "specimens/measures/crack_thresholds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
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
    EXPECT_TRUE(within("largest area strain, Pa", found.reversal, join, spacing));
    // Beyond `begin` the area strain is a parabola about `join`, so the middle of any stretch about its top is `join`.
    EXPECT_TRUE(within("crack damage, Pa", found.damage, join, spacing));
    EXPECT_TRUE(agrees("axial strain there", found.damage_strain, join / modulus, 2.0 * spacing / join));
    // k x² is 2 % of the largest area strain, (1 - ν)/E (begin + join)/2, at x from `join`.
    EXPECT_TRUE(
        within("its error, Pa", found.damage_error, std::sqrt(0.02 * (join - begin) * (join + begin)), spacing));
    // The fit has trial stresses of 1/200 of crack damage, and no stress of `begin` among them.
    EXPECT_TRUE(within("opening, Pa", found.initiation(), begin, join / 200.0));
    // Where 2 k (σ - begin) is a fifth of ν/E.
    const double compliant = begin + 0.2 * ratio * (join - begin) / (1.0 - ratio);
    EXPECT_TRUE(within("lateral compliance, Pa", found.lateral_compliance, compliant, spacing));
    EXPECT_TRUE(
        within("error of crack initiation, Pa", found.initiation_error(), compliant - begin, spacing + join / 200.0));
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
    EXPECT_TRUE(within("largest less smallest, Pa", found.spread(), farthest - begin, 3.0 * spacing + join / 200.0));
}

// What a specimen does after crack damage moves its peak, and so its number of breaks up to there.
TEST(CrackThresholds, OpeningAndLateralComplianceDoNotDependOnThePeak) {
    const std::vector<CurveRow> rows = cracking_curve();
    const CrackThresholds all = of(rows);
    constexpr int early = 900;  // beyond crack damage and the stretch about it
    const CrackThresholds cut = find_crack_thresholds(rows, early, modulus, ratio);
    EXPECT_TRUE(within("opening, Pa", cut.opening, all.opening, 0.0));
    EXPECT_TRUE(within("lateral compliance, Pa", cut.lateral_compliance, all.lateral_compliance, 0.0));
    EXPECT_TRUE(within("crack damage, Pa", cut.damage, all.damage, 0.0));
    EXPECT_NE(cut.first_percent, all.first_percent);
}

/// The pressure shifts all stresses, and its stage has left a lateral strain.
TEST(CrackThresholds, UnderPressureAreCountedFromWhereLoadingBegins) {
    constexpr double pressure = 10e6;
    std::vector<CurveRow> rows = cracking_curve();
    for (CurveRow& row : rows) {
        row.axial_stress += pressure;
        row.lateral_strain -= 3e-6;
    }
    const CrackThresholds free = of(cracking_curve());
    const CrackThresholds found = find_crack_thresholds(rows, rows_to_peak, modulus, ratio, pressure);
    EXPECT_TRUE(agrees("opening, Pa", found.opening, free.opening + pressure, 1e-12));
    EXPECT_TRUE(agrees("lateral compliance, Pa", found.lateral_compliance, free.lateral_compliance + pressure, 1e-12));
    EXPECT_TRUE(agrees("crack damage, Pa", found.damage, free.damage + pressure, 1e-12));
}

/// Cracks open one by one, by random widths, so that on average the curve is cracking_curve().
std::vector<CurveRow> bursting_curve(std::uint64_t seed) {
    constexpr std::size_t cracks = 400;
    std::mt19937_64 generator(seed);
    const double k = (1.0 - ratio) / (2.0 * modulus * (join - begin));
    const double mean = k * (peak - begin) * (peak - begin) / static_cast<double>(cracks);
    std::vector<std::pair<double, double>> opened;  // stress, widening
    for (std::size_t n = 0; n < cracks; ++n) {
        const double at = begin + (peak - begin) * std::sqrt(uniform_number(generator, 0.0, 1.0));
        // The cube of a uniform number has a wide tail, and the mean 1/4.
        opened.emplace_back(at, 4.0 * mean * std::pow(uniform_number(generator, 0.0, 1.0), 3));
    }
    std::ranges::sort(opened);
    std::vector<CurveRow> rows = cracking_curve();
    double wide = 0.0;
    std::size_t next = 0;
    for (CurveRow& row : rows) {
        for (; next < cracks && opened[next].first <= row.axial_stress; ++next) wide += opened[next].second;
        row.lateral_strain = ratio * row.axial_strain + wide;
        row.bonds_broken = next > 0 ? 1 : 0;  // a single burst, so that no time goes into the break of counts
    }
    return rows;
}

TEST(CrackThresholds, OfBurstsAreUnbiasedAndWithinTheirErrors) {
    constexpr int curves = 200;
    double initiation = 0.0, damage = 0.0, initiation_squares = 0.0, damage_squares = 0.0;
    int initiation_within = 0, damage_within = 0;
    for (int n = 0; n < curves; ++n) {
        const CrackThresholds found = of(bursting_curve(static_cast<std::uint64_t>(n)));
        const double first = found.initiation() - begin, second = found.damage - join;
        initiation += first / curves;
        damage += second / curves;
        initiation_squares += first * first / curves;
        damage_squares += second * second / curves;
        if (std::abs(first) <= found.initiation_error()) ++initiation_within;
        if (std::abs(second) <= found.damage_error) ++damage_within;
    }
    const double initiation_scatter = std::sqrt(initiation_squares), damage_scatter = std::sqrt(damage_squares);
    fmt::print(
        "  scatter of one curve: initiation {:.3g}, damage {:.3g} of the peak; within the stated error {} and {} "
        "of {}\n",
        initiation_scatter / peak, damage_scatter / peak, initiation_within, damage_within, curves);
    const double mean_error = 3.0 / std::sqrt(curves);  // three standard errors, in units of the scatter
    EXPECT_TRUE(
        within("mean error of crack initiation, Pa", initiation, 0.0, mean_error * initiation_scatter + join / 200.0));
    EXPECT_TRUE(within("mean error of crack damage, Pa", damage, 0.0, mean_error * damage_scatter + spacing));
    // A standard error covers 68 %; three standard deviations of 200 draws are 10 %.
    EXPECT_GE(initiation_within, (68 - 10) * curves / 100);
    EXPECT_GE(damage_within, (68 - 10) * curves / 100);
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
                std::isnan(no_sides.lateral_strain) && std::isnan(no_sides.initiation()) &&
                std::isnan(no_sides.initiation_error()));
    EXPECT_TRUE(std::isfinite(no_sides.first_percent) && std::isfinite(no_sides.count_break));
    for (CurveRow& row : rows) row.bonds_broken = 0;
    const CrackThresholds intact = of(rows);
    EXPECT_TRUE(std::isnan(intact.first_percent) && std::isnan(intact.count_break) && std::isnan(intact.spread()));
    EXPECT_TRUE(std::isnan(find_crack_thresholds(rows, -1, modulus, ratio).damage)) << "no peak";
    const CrackThresholds no_solve = find_crack_thresholds(cracking_curve(), rows_to_peak, std::nan(""), ratio);
    EXPECT_TRUE(std::isnan(no_solve.crack_strain) && std::isnan(no_solve.initiation()) &&
                std::isfinite(no_solve.damage));
}

TEST(CrackThresholds, OfSpecimensWithoutOpeningCracksHaveNoInitiation) {
    std::vector<CurveRow> unbroken = cracking_curve();
    for (CurveRow& row : unbroken) row.bonds_broken = 0;
    EXPECT_TRUE(std::isnan(of(unbroken).initiation()) && std::isnan(of(unbroken).lateral_compliance));
    EXPECT_TRUE(std::isfinite(of(unbroken).damage));
    std::vector<CurveRow> narrow = cracking_curve();
    for (CurveRow& row : narrow) row.lateral_strain = 0.9 * ratio * row.axial_strain;
    EXPECT_TRUE(std::isnan(of(narrow).initiation())) << "it widens less than an elastic specimen";
    std::vector<CurveRow> widening = cracking_curve();
    for (CurveRow& row : widening) row.lateral_strain = 2.0 * row.axial_strain;
    EXPECT_TRUE(std::isnan(of(widening).damage) && std::isnan(of(widening).initiation())) << "its area only grows";
}

}  // namespace
}  // namespace crackle::crack_thresholds_test
