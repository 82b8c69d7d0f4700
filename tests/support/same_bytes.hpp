// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle::testing {

template <class T, class Room>
bool same_bytes(const std::vector<T, Room>& a, const std::vector<T, Room>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Compares the results of the steps so far in two worlds with the same points.
inline void expect_same_run(const World& one, const World& other) {
    EXPECT_TRUE(same_bytes(one.bodies.state, other.bodies.state));
    EXPECT_TRUE(same_bytes(one.points.force, other.points.force));
    EXPECT_TRUE(same_bytes(one.points.shear_force, other.points.shear_force));
    EXPECT_TRUE(same_bytes(one.points.normal_dashpot, other.points.normal_dashpot));
    EXPECT_TRUE(same_bytes(one.points.shear_dashpot, other.points.shear_dashpot));
    EXPECT_TRUE(same_bytes(one.points.bond_overlap, other.points.bond_overlap));
    EXPECT_TRUE(same_bytes(one.points.stiffness_share, other.points.stiffness_share));
    EXPECT_TRUE(same_bytes(one.points.strength_share, other.points.strength_share));
    EXPECT_TRUE(same_bytes(one.points.strong_normal, other.points.strong_normal));
    EXPECT_TRUE(same_bytes(one.points.strong_shear, other.points.strong_shear));
    EXPECT_EQ(one.bonds.broken, other.bonds.broken);
    EXPECT_EQ(one.account.dashpot_loss, other.account.dashpot_loss);
    EXPECT_EQ(one.account.friction_loss, other.account.friction_loss);
    EXPECT_EQ(one.account.fracture_loss, other.account.fracture_loss);
    EXPECT_EQ(one.account.displacement_work, other.account.displacement_work);
    EXPECT_EQ(one.account.force_work, other.account.force_work);
    EXPECT_EQ(one.stepping.time_step, other.stepping.time_step);
}

}  // namespace crackle::testing
