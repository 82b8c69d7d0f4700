// SPDX-License-Identifier: GPL-3.0-or-later
// What springs bore in the last force pass, for those who look after the step: between steps shear springs are those of
// that pass, while bodies have moved on by a drift. They are taken back by it, which is exact to rounding.
// Tested by tests/solver/measure/last_pass_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// One contact point in the last force pass.
struct PointLoad {
    Vec2 force;   // N, of its springs on body_i, less the back-tension of its bond; body_j has the opposite
    Vec2 place;   // m, midway between the two surfaces
    Vec2 normal;  // unit, from i to j
};
PointLoad load_of_last_pass(const World& world, PointIndex point);
/// Whether it can have borne anything.
inline bool bore_in_last_pass(const World& world, PointIndex point) {
    return (world.points.state[point].flags & (point_touching | point_bonded)) != 0;
}

/// s, of the last force pass.
double time_of_last_pass(const World& world);

}  // namespace crackle
