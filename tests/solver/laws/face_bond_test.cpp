// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a face: its moduli, its envelope, and the pressure of edges after failure against integration.

#include "solver/laws/face_bond.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/errors.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

TEST(FaceModuli, GiveTheArealModulusForEveryShearRatio) {
    const double nu = 0.26;
    for (const double ratio : {1.0, 1.0 / 1.6, 1.0 / 3.0})
        for (const double correction : {0.0, 0.3}) {
            const FaceModuli m = face_moduli(2.0, nu, ratio, correction);
            EXPECT_TRUE(agrees("E_c/2 + lambda", 0.5 * m.contact + m.pressure, 1.0 / (1.0 - nu), 1e-15));
        }
}

TEST(FaceModuli, AreThoseOfLameForEqualStiffnesses) {
    const double nu = 0.3;
    const FaceModuli m = face_moduli(1.0, nu, 1.0, 0.3);
    EXPECT_TRUE(agrees("E_c is twice the shear modulus", m.contact, 1.0 / (1.0 + nu), 1e-15));
    EXPECT_TRUE(agrees("lambda of plane stress", m.pressure, nu / (1.0 - nu * nu), 1e-14));
}

TEST(FaceModuli, NeedNoPressureAtOneShearRatio) {
    for (const double correction : {0.0, 0.3}) {
        const FaceModuli without = face_moduli_without_pressure(1.0, 0.2, correction);
        const FaceModuli with = face_moduli(1.0, 0.2, without.shear_ratio, correction);
        EXPECT_TRUE(within("lambda at this ratio", with.pressure, 0.0, 1e-15));
        EXPECT_TRUE(agrees("E_c at this ratio", with.contact, without.contact, 1e-14));
    }
    EXPECT_TRUE(agrees("kappa = (1 - 3 nu)/(1 + nu)", face_moduli_without_pressure(1.0, 0.2, 0.0).shear_ratio,
                       0.4 / 1.2, 1e-15));
}

TEST(FaceModuli, RefuseAPoissonsRatioThatWouldNeedANegativePressure) {
    EXPECT_NO_THROW(face_moduli(1.0, 0.1035, 1.0 / 1.6, 0.0));
    EXPECT_THROW(face_moduli(1.0, 0.1034, 1.0 / 1.6, 0.0), InputError);
    EXPECT_THROW(face_moduli_without_pressure(1.0, 0.34, 0.0), InputError);
}

FaceLaw rock() {
    FaceLaw law;
    law.tensile_strength = 10.0;
    law.cohesion = 40.0;
    law.friction = std::tan(50.0 * std::numbers::pi / 180.0);
    law.knee = 120.0;
    law.friction_beyond = std::tan(20.0 * std::numbers::pi / 180.0);
    law.moment_share = 0.6;
    law.residual_friction = std::tan(15.0 * std::numbers::pi / 180.0);
    return law;
}

/// Fails a little beyond the forces, and holds a little within them. @param all whether all three forces are scaled
void expect_on_envelope(const FaceLaw& law, double length, double share, FaceForces f, FaceFailure mode) {
    constexpr double little = 1e-9;
    const auto scaled = [&](double by) {
        // Compression is kept: it raises the shear strength.
        return FaceForces{f.normal > 0.0 ? by * f.normal : f.normal, by * f.shear, by * f.moment};
    };
    EXPECT_EQ(face_failure(law, length, share, scaled(1.0 + little)), mode) << f.normal << " " << f.shear;
    EXPECT_EQ(face_failure(law, length, share, scaled(1.0 - little)), FaceFailure::none) << f.normal << " " << f.shear;
}

TEST(FaceFailure, IsAtTheEnvelopeForAFacePulledShearedAndBent) {
    const FaceLaw law = rock();
    const double length = 0.02, share = 1.3;
    const double tensile = share * law.tensile_strength, cohesion = share * law.cohesion;
    expect_on_envelope(law, length, share, {tensile * length, 0.0, 0.0}, FaceFailure::tension);
    expect_on_envelope(law, length, share, {0.0, cohesion * length, 0.0}, FaceFailure::shear);
    expect_on_envelope(law, length, share, {0.0, 0.0, -tensile * length * length / (6.0 * law.moment_share)},
                       FaceFailure::tension);
}

TEST(FaceFailure, IsAtTheEnvelopeForSevenCombinations) {
    const FaceLaw law = rock();
    const double length = 0.02, share = 0.8;
    const double tensile = share * law.tensile_strength, cohesion = share * law.cohesion;
    for (const double compression : {-0.9 * tensile, -0.3 * tensile, 0.0, 30.0, 119.0, 121.0, 400.0}) {
        // The envelope in two straight pieces, from the header's equations.
        const double strength = compression <= law.knee ? cohesion + compression * law.friction
                                                        : cohesion + law.knee * law.friction +
                                                              (compression - law.knee) * law.friction_beyond;
        for (const double sign : {-1.0, 1.0}) {
            const FaceForces f{-compression * length, sign * strength * length, 0.0};
            // In tension the shear alone is scaled, so that the normal force stays within the cut-off.
            const auto with = [&](double by) { return FaceForces{f.normal, by * f.shear, 0.0}; };
            EXPECT_EQ(face_failure(law, length, share, with(1.0 + 1e-9)), FaceFailure::shear) << compression;
            EXPECT_EQ(face_failure(law, length, share, with(1.0 - 1e-9)), FaceFailure::none) << compression;
        }
    }
}

TEST(FaceFailure, TakesTheLargerRatioIfBothLimitsAreExceeded) {
    FaceLaw law;
    law.tensile_strength = 10.0;
    law.cohesion = 20.0;
    EXPECT_EQ(face_failure(law, 1.0, 1.0, {12.0, 22.0, 0.0}), FaceFailure::tension);
    EXPECT_EQ(face_failure(law, 1.0, 1.0, {11.0, 26.0, 0.0}), FaceFailure::shear);
    EXPECT_EQ(face_failure(law, 1.0, 1.0, {11.0, -26.0, 0.0}), FaceFailure::shear);
}

TEST(LapPressure, IsTheIntegralOfALinearPressureWithoutTension) {
    const double stiffness = 3.0, a = 0.7;
    for (const double turn : {0.4, -0.4, 0.05, 0.0}) {
        for (const double opening : {-0.5, -0.2, -0.03, 0.0, 0.03, 0.2, 0.5}) {
            const LapPressure got = lap_pressure(stiffness, a, opening, turn);
            double force = 0.0, moment = 0.0, energy = 0.0;
            constexpr int parts = 200'000;
            for (int n = 0; n < parts; ++n) {
                const double xi = a * (2.0 * (n + 0.5) / parts - 1.0), w = std::min(0.0, opening - turn * xi);
                const double width = 2.0 * a / parts;
                force += stiffness * w * width;
                moment -= stiffness * w * xi * width;
                energy += 0.5 * stiffness * w * w * width;
            }
            EXPECT_NEAR(got.force, force, 1e-9);
            EXPECT_NEAR(got.moment, moment, 1e-9);
            EXPECT_NEAR(got.energy, energy, 1e-9);
            const LapPressure pull = lap_tension(stiffness, a, opening, turn);
            EXPECT_NEAR(got.force + pull.force, stiffness * 2.0 * a * opening, 1e-15);
            EXPECT_NEAR(got.closed + pull.closed, 2.0 * a, 1e-15);
        }
    }
}

TEST(LapPressure, IsContinuousWhereItClosesAndWhereItOpens) {
    const double stiffness = 3.0, a = 0.7, turn = 0.2;
    for (const double edge : {-a * turn, a * turn}) {
        const LapPressure below = lap_pressure(stiffness, a, edge - 1e-12, turn),
                          above = lap_pressure(stiffness, a, edge + 1e-12, turn);
        EXPECT_NEAR(below.force, above.force, 1e-11);
        EXPECT_NEAR(below.moment, above.moment, 1e-11);
        EXPECT_NEAR(below.energy, above.energy, 1e-11);
    }
}

TEST(LapPressure, IsTheGradientOfItsEnergy) {
    const double stiffness = 3.0, a = 0.7, step = 1e-6;
    for (const double turn : {0.4, -0.4}) {
        for (const double opening : {-0.5, -0.1, 0.1}) {
            const auto energy = [&](double d, double phi) { return lap_pressure(stiffness, a, d, phi).energy; };
            const LapPressure got = lap_pressure(stiffness, a, opening, turn);
            EXPECT_NEAR(got.force, (energy(opening + step, turn) - energy(opening - step, turn)) / (2.0 * step), 1e-9);
            EXPECT_NEAR(got.moment, (energy(opening, turn + step) - energy(opening, turn - step)) / (2.0 * step), 1e-9);
        }
    }
}

TEST(FaceSlip, ReturnsTheShearForceToACohesionThatFallsWithTheSlip) {
    FaceLaw law;
    law.cohesion = 5.0;
    law.residual_cohesion = 1.0;
    law.softening_slip = 0.4;
    law.residual_friction = 0.5;
    const double stiffness = 40.0, glued = 0.8, pressing = 2.0, slipped = 0.1;
    const auto limit = [&](double u) { return 0.5 * pressing + glued * (1.0 + 4.0 * std::max(0.0, 1.0 - u / 0.4)); };
    EXPECT_EQ(slip_of_face(law, 0.999 * limit(slipped), stiffness, pressing, glued, slipped, 1.0).slip, 0.0);
    for (const double trial : {5.0, -8.0, 30.0}) {
        const FaceSlip got = slip_of_face(law, trial, stiffness, pressing, glued, slipped, 1.0);
        EXPECT_TRUE(agrees("force at the limit after the slip", std::abs(got.force),
                           limit(slipped + std::abs(got.slip)), 1e-14));
        EXPECT_TRUE(agrees("force less the spring's loss", got.force, trial - stiffness * got.slip, 1e-14));
    }
}

TEST(FaceLaw, RefusesAResidualStrengthThatPassesThePeak) {
    EXPECT_NO_THROW(check_face_law(rock()));
    FaceLaw law = rock();
    law.residual_friction = 1.01 * law.friction_beyond;
    EXPECT_THROW(check_face_law(law), InputError);
    law = rock();
    law.residual_cohesion = 1.01 * law.cohesion;
    EXPECT_THROW(check_face_law(law), InputError);
    law = rock();
    law.cohesion = 0.99 * law.friction * law.tensile_strength;
    EXPECT_THROW(check_face_law(law), InputError);
    law = rock();
    law.residual_tensile_strength = 1.01 * law.tensile_strength;
    EXPECT_THROW(check_face_law(law), InputError);
    law = rock();
    law.moment_share = 1.1;
    EXPECT_THROW(check_face_law(law), InputError);
    EXPECT_NO_THROW(check_face_law(FaceLaw{}));
}

}  // namespace
}  // namespace crackle
