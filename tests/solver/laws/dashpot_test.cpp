// SPDX-License-Identifier: GPL-3.0-or-later
// Tests dashpots alone: closed forms for one point, and identical bytes for points in lanes.

#include "solver/laws/dashpot.hpp"

#include <cmath>
#include <random>

#include "tests/support/claim.hpp"

namespace crackle {
namespace {

ContactLaw damped_law(double shear_stiffness) {
    ContactLaw law{};
    law.normal_stiffness = 1e7;
    law.shear_stiffness = shear_stiffness;
    law.friction = 0.5;
    law.normal_damping = 100.0;
    law.shear_damping = 40.0;
    law.normal_damping_ratio_term = 2.0 * 0.2 * std::sqrt(1e7);
    law.shear_damping_ratio_term = 2.0 * 0.2 * std::sqrt(2e6);
    return law;
}

TEST(Dashpot, IsItsConstantAndTwiceTheRatioTimesTheRootOfStiffnessAndMass) {
    const ContactLaw law = damped_law(2e6);
    const double mass = 0.3;
    EXPECT_TRUE(testing::agrees("c_n, N s/m", normal_damping(law, std::sqrt(mass)), 100.0 + 0.4 * std::sqrt(1e7 * mass),
                                1e-14));
    EXPECT_TRUE(
        testing::agrees("c_s, N s/m", shear_damping(law, std::sqrt(mass)), 40.0 + 0.4 * std::sqrt(2e6 * mass), 1e-14));
}

TEST(Dashpot, OfShearRestsWhileThePointSlidesAndHasCoulombsLimitWithoutASpring) {
    const double root_mass = 0.5, overlap = 1e-5, limit = 0.5 * 1e7 * overlap;
    const Law<double> with_spring(damped_law(2e6)), alone(damped_law(0.0));
    const double c_s = shear_damping(damped_law(2e6), root_mass);
    EXPECT_TRUE(
        testing::agrees("c_s v, N", shear_dashpot(with_spring, root_mass, 0.01, overlap, false), 0.01 * c_s, 1e-14));
    EXPECT_EQ(shear_dashpot(with_spring, root_mass, 0.01, overlap, true), 0.0);
    EXPECT_TRUE(testing::agrees("at most the limit, N", shear_dashpot(alone, root_mass, -100.0, overlap, false), -limit,
                                1e-14));
}

TEST(Dashpot, LossIsTheWorkOfTheMeanForceOverTheDrift) {
    EXPECT_TRUE(testing::agrees("loss, J", dashpot_loss(1e-4, 30.0 + 50.0, 0.2, -8.0 - 4.0, -0.1),
                                1e-4 * (0.5 * 80.0 * 0.2 + 0.5 * 12.0 * 0.1), 1e-14));
}

TEST(Dashpot, LanesHaveTheBytesOfOnePoint) {
    std::mt19937_64 random(5);
    const auto any = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    for (const ContactLaw& constants : {damped_law(2e6), damped_law(0.0)}) {
        const Law<double> one(constants);
        const Law<Lanes> several(constants);
        for (int n = 0; n < 200; ++n) {
            Lanes root_mass, rate, overlap;
            LaneBits slides{};
            for (int l = 0; l < lane_count; ++l) {
                root_mass[l] = std::abs(any()), rate[l] = 10.0 * any(), overlap[l] = 1e-5 * any();
                slides[l] = any() > 0.0 ? -1 : 0;
            }
            const Lanes force = shear_dashpot<Lanes>(several, root_mass, rate, overlap, slides);
            const Lanes damping = normal_damping(several, root_mass);
            for (int l = 0; l < lane_count; ++l) {
                EXPECT_EQ(force[l], shear_dashpot<double>(one, root_mass[l], rate[l], overlap[l], slides[l] != 0));
                const double alone = normal_damping(one, double{root_mass[l]});
                EXPECT_EQ(damping[l], alone);
            }
        }
    }
}

}  // namespace
}  // namespace crackle
