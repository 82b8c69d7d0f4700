// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle::throughput {

/// Four walls around all discs and corners of the scene. @param room m, between the outermost of them and the walls
void wall_in(Scene& scene, double room);

}  // namespace crackle::throughput
