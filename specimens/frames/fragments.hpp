// SPDX-License-Identifier: GPL-3.0-or-later
// Finds fragments: groups of particles that are still connected by bonds, directly or through other particles. Two
// particles are connected while at least one bonded point between them is intact. Platens belong to no fragment and do
// not connect particles.
// Tested by tests/specimens/frames/frame_forces_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "specimens/frames/frame.hpp"

namespace crackle {

/// Index of each body's fragment. Fragments are numbered from 0 by descending area; for equal areas, by lowest body id.
/// Platens have -1.
std::vector<std::int32_t> find_fragments(const World& world, const TestSetup& setup, const Frame& frame);

}  // namespace crackle
