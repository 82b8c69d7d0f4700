// SPDX-License-Identifier: GPL-3.0-or-later
// What a specimen has broken into, by size: diameters of discs of the fragments' areas.
// Tested by tests/specimens/measures/crack_rose_test.cpp.
#pragma once

#include <cstdint>

#include "specimens/frames/frame.hpp"
#include "specimens/statistics/rosin_rammler.hpp"

namespace crackle {

struct FragmentSizes {
    std::int64_t count = 0;      ///< a particle that nothing holds is one
    double largest_share = 0.0;  ///< of the particles' area
    double median_size = 0.0;    ///< m, D50: half of the area lies in fragments of at most this size
    RosinRammler law;            ///< of fragments of at least two mean particles
};
FragmentSizes measure_fragments(const World& world, const TestSetup& setup, const Frame& frame);

}  // namespace crackle
