// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "mesher/mirrored_seeds.hpp"

namespace crackle {
namespace {

TEST(Angles, AreThoseOfTheLibraryToAFewLastDigits) {
    for (int k = -3600; k <= 3600; ++k) {
        const double angle = k * 0.001745;
        const Point d = direction_at(angle);
        EXPECT_NEAR(d.x, std::cos(angle), 4e-15) << angle;
        EXPECT_NEAR(d.y, std::sin(angle), 4e-15) << angle;
        EXPECT_NEAR(angle_of(3.0 * d.x, 3.0 * d.y), std::atan2(d.y, d.x), 4e-15) << angle;
    }
}

TEST(Angles, AxesAreExact) {
    EXPECT_EQ(angle_of(2.0, 0.0), 0.0);
    EXPECT_EQ(angle_of(0.0, 2.0), 0.5 * std::numbers::pi);
    EXPECT_EQ(angle_of(-2.0, 0.0), std::numbers::pi);
    EXPECT_EQ(angle_of(0.0, -2.0), -0.5 * std::numbers::pi);
    EXPECT_NEAR(angle_of(1.0, 1.0), 0.25 * std::numbers::pi, 1e-15);
}

}  // namespace
}  // namespace crackle
