// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle::testing {

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What the steps so far have made of two worlds of the same points.
inline void expect_same_run(const World& one, const World& other) {
    EXPECT_TRUE(same_bytes(one.bodies, other.bodies));
    EXPECT_TRUE(same_bytes(one.point_forces, other.point_forces));
    EXPECT_TRUE(same_bytes(one.shear_forces, other.shear_forces));
    EXPECT_TRUE(same_bytes(one.normal_dashpot, other.normal_dashpot));
    EXPECT_TRUE(same_bytes(one.shear_dashpot, other.shear_dashpot));
    EXPECT_TRUE(same_bytes(one.strong_normal, other.strong_normal));
    EXPECT_TRUE(same_bytes(one.strong_shear, other.strong_shear));
    EXPECT_EQ(one.bonds_broken, other.bonds_broken);
    EXPECT_EQ(one.dashpot_loss, other.dashpot_loss);
    EXPECT_EQ(one.friction_loss, other.friction_loss);
    EXPECT_EQ(one.fracture_loss, other.fracture_loss);
    EXPECT_EQ(one.displacement_work, other.displacement_work);
    EXPECT_EQ(one.force_work, other.force_work);
    EXPECT_EQ(one.time_step, other.time_step);
}

}  // namespace crackle::testing
