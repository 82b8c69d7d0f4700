// SPDX-License-Identifier: GPL-3.0-or-later
// Flowing unbonded bodies: a column without its right wall during its collapse under gravity.
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include <cstdint>

#include "solver/scene/scene.hpp"

namespace crackle::throughput {

struct FlowingColumn {
    Scene scene;
    double lasts;  ///< duration of the flow, s
};

/// Bodies start with velocities of a collapse: v = √(g/H)·(x, −y) from the corner of floor and left wall, where H is
/// the column's height. The front then moves at √(gH), the speed of a dam break. Waiting for it to develop would take a
/// simulated time of about √(H/g), which means minutes for many bodies.
/// @param count approximate number of bodies @param polygons whether the bodies are hexagons instead of discs
FlowingColumn flowing_column(std::int64_t count, bool polygons);

}  // namespace crackle::throughput
