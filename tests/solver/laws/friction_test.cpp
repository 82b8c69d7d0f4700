// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the friction law alone: closed forms for one point, and identical bytes for points in lanes.

#include "solver/laws/friction.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/claim.hpp"

namespace crackle::friction_test {
namespace {

constexpr double k_n = 1e7, k_s = 2e6, mu = 0.5;

ContactLaw law_with(double friction, double shear_stiffness) {
    ContactLaw law{};
    law.normal_stiffness = k_n;
    law.shear_stiffness = shear_stiffness;
    law.friction = friction;
    return law;
}

TEST(Friction, SticksBelowCoulombsLimitAndSlidesAtIt) {
    const Law<double> law(law_with(mu, k_s));
    const double overlap = 1e-5, limit = mu * k_n * overlap;
    EXPECT_TRUE(testing::agrees("limit, N", coulomb_limit(law, overlap), limit, 1e-15));
    const ShearTrial<double> sticks = try_shear(law, 10.0, -1e-6, overlap);
    EXPECT_FALSE(sticks.slides);
    EXPECT_TRUE(testing::agrees("f_t - k_s du, N", shear_force(sticks), 12.0, 1e-15));
    const ShearTrial<double> slides = try_shear(law, -40.0, 1e-5, overlap);
    EXPECT_TRUE(slides.slides);
    EXPECT_TRUE(testing::agrees("limit with the sign of the trial, N", shear_force(slides), -limit, 1e-15));
}

TEST(Friction, SliderAndSpringTakeTheWorkOfTheMeanForce) {
    // Closed form: the work ½(f0 + f1)·Δu done against the force equals ½f1²/k - ½f0²/k + loss, whatever part of the
    // step slides.
    const Law<double> law(law_with(mu, k_s));
    const double before = -40.0, slip = 1e-5;
    const ShearTrial<double> trial = try_shear(law, before, slip, 1e-5);
    const double after = shear_force(trial);
    const double work = -0.5 * (before + after) * slip;
    const double stored = 0.5 * (after * after - before * before) / k_s;
    EXPECT_TRUE(testing::agrees("loss of the slider, J", slider_loss(law, trial, after), work - stored, 1e-13));
}

TEST(Friction, WithoutResistanceSlidesUnstrainedAndWithoutLimitNever) {
    EXPECT_TRUE(try_shear(Law<double>(law_with(mu, k_s)), 0.0, 0.0, -1e-6).slides);
    EXPECT_TRUE(try_shear(Law<double>(law_with(0.0, k_s)), 0.0, 0.0, 1e-6).slides);
    const Law<double> stuck(law_with(std::numeric_limits<double>::infinity(), k_s));
    for (const double overlap : {-1e-6, 0.0, 1e-6}) EXPECT_FALSE(try_shear(stuck, 1e9, 1.0, overlap).slides) << overlap;
}

TEST(Friction, LanesHaveTheBytesOfOnePoint) {
    std::mt19937_64 random(3);
    const auto any = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    for (const ContactLaw& constants : {law_with(mu, k_s), law_with(0.0, k_s), law_with(mu, 0.0)}) {
        const Law<double> one(constants);
        const Law<Lanes> several(constants);
        for (int n = 0; n < 200; ++n) {
            Lanes before, slip, overlap;
            for (int l = 0; l < lane_count; ++l)
                before[l] = 50.0 * any(), slip[l] = 1e-5 * any(), overlap[l] = 1e-5 * any();
            const ShearTrial<Lanes> trial = try_shear<Lanes>(several, before, slip, overlap);
            const Lanes force = shear_force(trial), loss = slider_loss(several, trial, force);
            for (int l = 0; l < lane_count; ++l) {
                const ShearTrial<double> alone = try_shear<double>(one, before[l], slip[l], overlap[l]);
                EXPECT_EQ(trial.slides[l] != 0, alone.slides);
                EXPECT_EQ(force[l], shear_force(alone));
                EXPECT_EQ(loss[l], slider_loss<double>(one, alone, shear_force(alone)));
            }
        }
    }
}

}  // namespace
}  // namespace crackle::friction_test
