// SPDX-License-Identifier: GPL-3.0-or-later
// Fragments: particles that bonds still hold together, directly or through others. Two particles are held together
// while one bonded point between them is intact. Platens belong to none and join none.
// Tested by tests/specimens/frames/frame_forces_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "specimens/frames/frame.hpp"

namespace crackle {

/// The number of each body's fragment: 0 the largest by area, and so on; of two as large, the one with the lowest id
/// comes first. Of platens -1.
std::vector<std::int32_t> find_fragments(const World& world, const TestSetup& setup, const Frame& frame);

}  // namespace crackle
