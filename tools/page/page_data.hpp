// SPDX-License-Identifier: GPL-3.0-or-later
// Converts recordings to text for a page: a manifest in JSON, and blocks of numbers, compressed with zlib and encoded
// as base64. tools/viewer/src/data/report.ts reads this layout.
//
// Block 0 of a recording contains plain little-endian arrays, each aligned to eight bytes: the parts that do not move,
// the curve, the breaks and, if recorded, the slips. For a deck it contains the curves listed as `curves` in the
// manifest. Curves are thinned to the rows in which a column has its maximum or minimum within each of 400 parts of the
// run. Each further block contains up to 16 frames. For each quantity it has a table of integers, with one row per
// frame and one column per cell or bond. Tables store the differences between rows in zigzag code (0, -1, 1, -2, ... as
// 0, 1, 2, 3, ...). The lowest bytes of all numbers come first, then the second bytes, and so on, so that similar and
// mostly small bytes are adjacent. The number of contacts other than bonds varies. Their tables therefore have a single
// row for all frames of the block, which stores differences between columns; `contacts.count` is the number of contacts
// in each frame. For positions, angles and integers, a stored number n means the value q·n, with q = 2⁻²² of the
// specimen's size for positions and 2⁻¹⁸ rad for angles. If an entry has a `growth` g, n means q/g·sinh(g·n). This is
// used for velocities, stresses and forces, whose small values are as important as large ones. The resolution is then
// √(q² + (g·value)²), with g = 2⁻⁷ (2⁻⁶ for forces and faces' stresses) and q = 2⁻²⁰ of the block's largest value.
// Tested by tests/tools/page/page_data_test.cpp.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle::tools {

struct PageData {
    nlohmann::ordered_json manifest;  ///< the recording's entry in the page's manifest
    std::vector<std::string> blocks;  ///< the blocks, encoded as base64
};

/// Converts all frames of a recording, block by block.
/// @param packed_frames called from time to time with the number of frames converted so far; may be empty
/// @throws InputError if a frame cannot be read or contains a number that is not finite
PageData pack_recording(const Recording& recording, const std::function<void(std::size_t)>& packed_frames = {});

}  // namespace crackle::tools
