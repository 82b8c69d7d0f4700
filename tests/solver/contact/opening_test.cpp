// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the bound that avoids reading the bodies' accelerations for most closed points.

#include "solver/contact/opening.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace crackle {
namespace {

TEST(Opening, WhatSurelyStaysClosedHasTheForceOfItsSpring) {
    std::mt19937_64 random(11);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const auto either_sign = [&](double size) { return size * (2.0 * unit() - 1.0); };
    constexpr double stiffness = 1e7, kick = 1e-5, step = 1e-5;  // N/m, s
    int stay = 0, open = 0;
    for (int n = 0; n < 200'000; ++n) {
        const PushBounds<double> bounds{std::exp(either_sign(12.0)), 0.1 + 5.0 * unit()};
        ClosingPoint a{};
        a.overlap = 1e-6 * std::exp(either_sign(6.0));
        a.closing = either_sign(a.overlap / step);
        a.acceleration = either_sign(bounds.acceleration);
        a.inverse_mass = bounds.inverse_mass * unit();
        a.stiffness = stiffness;
        a.dashpot = either_sign(0.1 * stiffness * a.overlap);
        a.drift = a.step = step;
        a.kick = kick;
        const double last = stiffness * a.overlap * (1.0 + either_sign(0.2));
        const double before = a.overlap - a.closing * step;
        const bool stays = stays_closed(stiffness, a.overlap, a.closing, last, a.dashpot, bounds, kick, step);
        OpeningMemory memory;
        const double force = opening_force(memory, last, true, before, a);
        const bool plain = force == stiffness * a.overlap && memory.extra_force == 0.0 && memory.defect == 0.0;
        ASSERT_TRUE(plain || !stays) << fmt::format("overlap {} m, closing {} m/s", a.overlap, a.closing);
        stay += stays ? 1 : 0;
        open += plain ? 0 : 1;
    }
    fmt::print("  {} surely stay, {} part\n", stay, open);
    EXPECT_GT(stay, 10'000);
    EXPECT_GT(open, 10'000);
}

TEST(Opening, NothingIsSureOfABodyThatHasNotBeenMoved) {
    const PushBounds<double> unknown{std::numeric_limits<double>::infinity(), 1.0};
    EXPECT_FALSE(stays_closed(1e7, 1e-3, 1.0, 1e4, 0.0, unknown, 1e-9, 1e-9));
}

}  // namespace
}  // namespace crackle
