// SPDX-License-Identifier: GPL-3.0-or-later
// Unbonded bodies that flow: a column without its right wall, in the midst of its collapse under gravity.
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include <cstdint>

#include "solver/scene/scene.hpp"

namespace crackle::throughput {

struct FlowingColumn {
    Scene scene;
    double lasts;  ///< s, in which it flows on
};

/// Bodies start with the motion of a collapse: v = √(g/H)·(x, −y) from the corner of floor and left wall, H the
/// column's height. The front then has √(gH), the speed of a dam break. Waiting for it would take simulated time of the
/// order √(H/g), minutes with many bodies.
/// @param count bodies, met within a few @param polygons hexagons in place of discs
FlowingColumn flowing_column(std::int64_t count, bool polygons);

}  // namespace crackle::throughput
