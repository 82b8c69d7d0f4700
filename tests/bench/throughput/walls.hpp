// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle::throughput {

/// Adds four walls around all discs and corners of the scene. @param room distance of each wall from the nearest disc
/// or corner, m
void wall_in(Scene& scene, double room);

}  // namespace crackle::throughput
