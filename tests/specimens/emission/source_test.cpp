// SPDX-License-Identifier: GPL-3.0-or-later
// Tests sources whose moments are known: opening, slip and closing in any direction.

#include "specimens/emission/source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "specimens/emission/acoustic_event.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

Vec2 turned(Vec2 v, double angle) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Two forces of 3 N at arms of 0.1 m on either side. With `sense` 1 they point away from each other; `force_turn`
/// rotates them relative to the arms, and `angle` rotates everything. M has 2·3·0.1 N m along the line.
MomentTensor dipole(double sense, double force_turn, double angle) {
    MomentTensor moment;
    for (const double side : {-1.0, 1.0}) {
        const Vec2 arm = turned({0.1 * side, 0.0}, angle);
        moment.add(sense * 30.0 * turned(arm, force_turn), arm);
    }
    return moment;
}

MomentTensor sum(const MomentTensor& a, const MomentTensor& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}

constexpr double right_angle = 0.5 * std::numbers::pi;

TEST(MomentTensorOfASource, IsTheSameInAnyDirection) {
    for (const double angle : {0.0, 0.3, 1.2, 2.5}) {
        const MomentTensor line = dipole(1.0, 0.0, angle), all_round = sum(line, dipole(1.0, 0.0, angle + right_angle));
        // A couple, and a second couple that balances its torque.
        const MomentTensor slip = sum(dipole(1.0, right_angle, angle), dipole(1.0, -right_angle, angle + right_angle));
        EXPECT_TRUE(agrees("opening along a line, N m", scalar_moment(line), 0.6 / std::numbers::sqrt2, 1e-12));
        EXPECT_TRUE(agrees("R", isotropic_percent(line), 50.0, 1e-12));
        EXPECT_TRUE(agrees("opening all round, N m", scalar_moment(all_round), 0.6, 1e-12));
        EXPECT_TRUE(agrees("R", isotropic_percent(all_round), 100.0, 1e-12));
        EXPECT_TRUE(agrees("slip, N m", scalar_moment(slip), 0.6, 1e-12));
        EXPECT_TRUE(within("R", isotropic_percent(slip), 0.0, 1e-12));
        EXPECT_EQ(source_type(isotropic_percent(line)), SourceType::opening);
        EXPECT_EQ(source_type(isotropic_percent(slip)), SourceType::shear);
        EXPECT_EQ(source_type(isotropic_percent(dipole(-1.0, 0.0, angle))), SourceType::closing);
        const PrincipalMoments m = principal_moments(line);
        EXPECT_TRUE(within("along the line", std::abs(std::sin(m.direction - angle)), 0.0, 1e-12));
        EXPECT_TRUE(agrees("its moment, N m", m.largest, 0.6, 1e-12));
        EXPECT_TRUE(within("across", m.smallest, 0.0, 1e-15));
        EXPECT_TRUE(agrees("a slip's two moments are opposite", principal_moments(slip).smallest,
                           -principal_moments(slip).largest, 1e-12));
    }
}

TEST(MomentTensorOfASource, HasNoPartInItsTorque) {
    // For a single couple, half of the tensor is torque.
    EXPECT_TRUE(agrees("N m", scalar_moment(dipole(1.0, right_angle, 0.7)), 0.3, 1e-12));
}

TEST(SourceType, ChangesAtThirtyPercent) {
    // For moments m and q m, R = 100 (1 + q)/((1 + q) + (1 - q)) = 50 (1 + q).
    for (const double q : {-0.41, -0.39}) {
        const MomentTensor moment = sum(dipole(1.0, 0.0, 0.4), dipole(q, 0.0, 0.4 + right_angle));
        EXPECT_TRUE(agrees("R", isotropic_percent(moment), 50.0 * (1.0 + q), 1e-12));
        EXPECT_EQ(source_type(isotropic_percent(moment)), q < -0.4 ? SourceType::shear : SourceType::opening);
        const MomentTensor opposite = sum(dipole(-1.0, 0.0, 0.4), dipole(-q, 0.0, 0.4 + right_angle));
        EXPECT_EQ(source_type(isotropic_percent(opposite)), q < -0.4 ? SourceType::shear : SourceType::closing);
    }
}

/// Value of an event in a column of ae.csv.
std::string column_of(const AcousticEvent& event, double thickness, const std::string& name) {
    for (const AcousticColumn& column : acoustic_columns())
        if (column.what.name == name) return column.text(event, thickness);
    return "no such column";
}

TEST(AcousticColumns, HaveMagnitudesOfTheWholeThickness) {
    constexpr double thickness = 0.05;
    AcousticEvent event;
    event.energy = std::pow(10.0, 4.8) / thickness;                       // Me = 0
    event.moment.xx = event.moment.yy = std::pow(10.0, 4.5) / thickness;  // Mw = -3
    EXPECT_TRUE(within("Mw", std::stod(column_of(event, thickness, "moment_magnitude")), -3.0, 1e-12));
    EXPECT_TRUE(within("Me", std::stod(column_of(event, thickness, "energy_magnitude")), 0.0, 1e-12));
}

TEST(AcousticColumns, HaveTheSymmetricPartOfTheMoment) {
    AcousticEvent event;
    event.moment = {2.0, 3.0, 5.0, -6.0};
    EXPECT_EQ(column_of(event, 1.0, "moment_xx"), "2");
    EXPECT_EQ(column_of(event, 1.0, "moment_xy"), "4");
    EXPECT_EQ(column_of(event, 1.0, "moment_yy"), "-6");
    // With tr M = -4 and a deviator of 2 sqrt(4² + 4²), R = -100 4/(4 + 11.31).
    EXPECT_TRUE(
        agrees("R", std::stod(column_of(event, 1.0, "isotropic")), -400.0 / (4.0 + 8.0 * std::sqrt(2.0)), 1e-12));
    EXPECT_EQ(column_of(event, 1.0, "type"), "shear");
    event.moment = {};
    EXPECT_EQ(column_of(event, 1.0, "type"), "none");
    EXPECT_EQ(column_of(event, 1.0, "moment_magnitude"), "nan");
}

TEST(Magnitude, OfMomentAndEnergyIsThatOfTheFormulas) {
    EXPECT_TRUE(within("Mw of 1e9 N m", moment_magnitude(1e9), 0.0, 1e-12));
    EXPECT_TRUE(agrees("Mw of 1 mN m", moment_magnitude(1e-3), -8.0, 1e-12));
    EXPECT_TRUE(within("Me of 10^4.8 J", energy_magnitude(std::pow(10.0, 4.8)), 0.0, 1e-12));
    EXPECT_TRUE(std::isinf(moment_magnitude(0.0)));
    EXPECT_TRUE(std::isnan(isotropic_percent({})));
}

}  // namespace
}  // namespace crackle
