// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of a specimen's fragments; the size of a fragment is the diameter of a disc of equal area.
// Tested by tests/specimens/measures/crack_rose_test.cpp.
#pragma once

#include <cstdint>

#include "specimens/frames/frame.hpp"
#include "specimens/statistics/rosin_rammler.hpp"

namespace crackle {

/// Number and sizes of the fragments of a specimen.
struct FragmentSizes {
    std::int64_t count = 0;      ///< number of fragments; a particle without bonds is a fragment
    double largest_share = 0.0;  ///< area of the largest fragment relative to the area of all particles
    double median_size = 0.0;    ///< m, D50: half of the area is in fragments of at most this size
    RosinRammler law;            ///< size distribution of the fragments with an area of at least two mean particles
};
/// Measures the fragments in a frame: groups of bodies that bonds hold together.
FragmentSizes measure_fragments(const World& world, const TestSetup& setup, const Frame& frame);

}  // namespace crackle
