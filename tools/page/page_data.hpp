// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings as the text that the page carries: a manifest in JSON, and blocks of numbers, compressed with zlib and
// written as base64. tools/viewer/src/data/report.ts reads the same layout.
//
// Block 0 of a recording holds plain little-endian arrays, each on a multiple of eight bytes: what never moves, the
// curve, the breaks, and the slips where the test recorded them; of a deck its curves (`curves` in the manifest),
// thinned to the rows at which one of their columns is highest or lowest in each of 400 parts of the run. Each further
// block holds up to 16 frames: for each quantity of cells or bonds a table of whole numbers, rows frames, columns cells
// or bonds. What is stored are the differences from row to row, zigzag coded (0, -1, 1, -2, ... as 0, 1, 2, 3, ...),
// lowest bytes of all first, then the second ones: bytes of equal meaning lie together, and most are small. Contacts
// other than bonds come and go: their tables have one row for all frames of the block, differences from column to
// column, and `contacts.count` holds how many each frame has. A number n stands for the value q·n of places (q = 2⁻²²
// of the specimen's size), angles (2⁻¹⁸ rad) and whole numbers; where an entry has a `growth` g, for q/g·sinh(g·n):
// velocities, stresses and forces, whose small values mean as much as their large ones. Neighbours are then √(q² +
// (g·value)²) apart, with g = 2⁻⁷, of forces 2⁻⁶, and q = 2⁻²⁰ of the block's largest value. Tested by
// tests/tools/page/page_data_test.cpp.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle::tools {

struct PageData {
    nlohmann::ordered_json manifest;  ///< entry of the recording
    std::vector<std::string> blocks;  ///< base64
};

/// Reads all frames of the recording, one block after the other.
/// @param packed_frames  called with how many frames are packed, now and then; may be empty
/// @throws InputError where a frame cannot be read or holds what is no finite number
PageData pack_recording(const Recording& recording, const std::function<void(std::size_t)>& packed_frames = {});

}  // namespace crackle::tools
